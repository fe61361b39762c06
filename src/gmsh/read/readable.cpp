// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/readable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 33> kMeshExtensions = {
    ".bdf",  ".celum", ".cgns", ".dat",  ".diff", ".inp",   ".ir3",  ".key",  ".m",     ".mail",  ".med",
    ".mesh", ".mmed",  ".msh",  ".msh1", ".msh2", ".msh22", ".msh3", ".msh4", ".msh40", ".msh41", ".nas",
    ".neu",  ".obj",   ".off",  ".p3d",  ".ply",  ".ply2",  ".rmed", ".stl",  ".su2",   ".unv",   ".vtk"};
constexpr std::array<std::string_view, 9> kCadExtensions = {".brep", ".brp", ".iges",    ".igs",    ".step",
                                                            ".stp",  ".x_t", ".xmt_txt", ".xmt_bin"};

constexpr std::array<std::string_view, 8> kScriptExtensions = {"",     ".geo", ".geo_unrolled", ".gmsh",
                                                               ".opt", ".pos", ".script",       ".txt"};

bool has_extension_of(const std::string& path, const auto& extensions) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

/// Gmsh takes what it does not know by name for a script, unless it begins like one of its own files.
bool is_binary_script(const std::string& path, std::istream& in) {
  if (is_mesh_file(path) || is_cad_file(path)) return false;
  std::array<char, 4096> buffer{};
  in.read(buffer.data(), buffer.size());
  const std::string_view head(buffer.data(), static_cast<std::size_t>(in.gcount()));
  return head.find('\0') != std::string_view::npos && head[0] != '$';
}

}  // namespace

bool is_mesh_file(const std::string& path) { return has_extension_of(path, kMeshExtensions); }

bool is_script(const std::string& path) { return has_extension_of(path, kScriptExtensions); }

bool is_cad_file(const std::string& path) { return has_extension_of(path, kCadExtensions); }

/// Gmsh before 4.12 says nothing about a missing file, and asks no further about the others.
void check_readable(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(fmt::format("{}: no such file", path));
  if (fs::is_directory(status)) throw InputError(fmt::format("{} is a directory", path));
  if (!fs::is_regular_file(status))  // it has no size, and perhaps no end
    throw InputError(
        fmt::format("{} is not a regular file; what comes through a pipe is read from standard input (-)", path));
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(fmt::format("{} cannot be read", path));
  if (fs::file_size(path, error) == 0) throw InputError(fmt::format("{} is empty", path));
  if (is_binary_script(path, in))
    throw InputError(fmt::format("{} is binary, and of no format that Gmsh reads under this name", path));
}

}  // namespace qmorph::adapter
