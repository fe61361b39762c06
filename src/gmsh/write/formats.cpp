// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/write/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

struct FormatRow {
  std::string_view name, extension;
  double msh_version;  ///< 0: not MSH; -1: MSH of whatever version fits
  bool holds_quads;
  int max_order = 10, quad_nodes = 0;  ///< as in OutputFormat
};

/// Gmsh's mesh formats. The extension makes gmsh::write take the format; the name is what -format says.
constexpr std::array kFormats = {
    FormatRow{"msh", ".msh", -1, true},        FormatRow{"msh1", ".msh1", 1, true},
    FormatRow{"msh2", ".msh2", 2.2, true},     FormatRow{"msh22", ".msh22", 2.2, true},
    FormatRow{"msh3", ".msh3", 3, true},       FormatRow{"msh4", ".msh4", 4.1, true},
    FormatRow{"msh40", ".msh40", 4, true},     FormatRow{"msh41", ".msh41", 4.1, true},
    FormatRow{"unv", ".unv", 0, true, 2, 8},    // 95: parabolic shells of 8 nodes
    FormatRow{"vtk", ".vtk", 0, true, 2},       // 23 and 28
    FormatRow{"mesh", ".mesh", 0, true, 2, 9},  // QuadrilateralsQ2
    FormatRow{"bdf", ".bdf", 0, true, 2, 8},    // CQUAD8
    FormatRow{"inp", ".inp", 0, true, 2, 8},    // CPS8
    FormatRow{"key", ".key", 0, true, 2, 8},   FormatRow{"dat", ".dat", 0, true, 2, 9},  // Tochnog's -quad9
    FormatRow{"diff", ".diff", 0, true, 2},    FormatRow{"ir3", ".ir3", 0, true, 2},
    FormatRow{"su2", ".su2", 0, true, 1},      FormatRow{"m", ".m", 0, true},
    FormatRow{"cgns", ".cgns", 0, true},       FormatRow{"med", ".med", 0, true, 2},
    FormatRow{"off", ".off", 0, true, 1},      FormatRow{"obj", ".obj", 0, true, 1},
    FormatRow{"stl", ".stl", 0, false},        FormatRow{"ply2", ".ply2", 0, false},
    FormatRow{"p3d", ".p3d", 0, false},        FormatRow{"celum", ".celum", 0, false},
    FormatRow{"neu", ".neu", 0, false},        FormatRow{"wrl", ".wrl", 0, false},
    FormatRow{"x3d", ".x3d", 0, false},        FormatRow{"mail", ".mail", 0, false},
};

OutputFormat make_format(const FormatRow& row) {
  if (!row.holds_quads) throw OutputError(fmt::format("the format {} cannot hold quads", row.name));
  OutputFormat format;
  format.name = row.name;
  format.extension = row.extension;
  format.is_msh = row.msh_version != 0;
  format.msh_version = std::max(row.msh_version, 0.0);
  format.max_order = row.max_order;
  format.quad_nodes = row.quad_nodes;
  return format;
}

}  // namespace

OutputFormat format_by_name(const std::string& name) {
  for (const FormatRow& row : kFormats)
    if (row.name == name) return make_format(row);
  throw UsageError(
      fmt::format("unknown format '{}' (one of msh, msh2, msh4, vtk, inp, su2, unv, bdf, mesh, ...)", name));
}

OutputFormat format_by_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const FormatRow& row : kFormats)
    if (row.extension == extension) return make_format(row);
  throw OutputError(fmt::format("cannot write {}: unknown extension '{}' (.msh, .vtk, .inp, .su2, ...; or use -format)",
                                path, extension));
}

std::string default_extension(const OutputFormat& format) { return format.is_msh ? ".msh" : format.extension; }

}  // namespace qmorph::adapter
