// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/request/options.hpp"

#include <fmt/format.h>

#include <array>

#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

constexpr std::array kRows = {
    Row{"o", "-o FILE", 1, "write to FILE; without it: IN with the extension of the format; -: standard output"},
    Row{"format", "-format NAME", 1,
        "msh, msh2, msh4, vtk, inp, su2, unv, bdf, mesh, ...; wins over the extension of FILE"},
    Row{"f", "", 1, ""},
    Row{"bin", "-bin", 0, "binary output, for formats that have it"},
    Row{"2", "-2", 0, "surfaces, which is what it does anyway"},
    Row{"3", "-3", 0, "then volumes on the quads, by Gmsh: pyramids and tetrahedra"},
    Row{"save", "-save", 0, "do not mesh: convert what is there"},
    Row{"part", "-part N", 1, "cut the result into N partitions"},
    Row{"nt", "-nt N", 1, "threads (default: all of the machine); the result does not depend on it"},
    Row{"v", "-v N", 1, "0: errors only, 1: and the summary, 2 and more: and Gmsh's warnings (default 5)"},
    Row{"surfaces", "--surfaces T,T,...", 1, "convert the surfaces with these tags only"},
    Row{"drop-volumes", "--drop-volumes", 0, "remove volume elements, so that their surfaces may become quads"},
    Row{"all-quad", "--all-quad", 0,
        "no triangle at all: where a boundary is odd, as few curve segments as possible get a node"},
    Row{"keep-curves", "--keep-curves T,...", 1, "curves with these tags get none"},
    Row{"cleanup-only", "--cleanup-only", 0,
        "improve quads, by Gmsh or anyone, that are there already; triangles among them are paired"},
    Row{"orient", "--orient", 0, "turn elements so that neighbours agree; counterclockwise where the model is flat"},
    Row{"layers", "--layers on|off", 1,
        "on (default): rows of triangles along walls stay rows of quads, with the heights that they have"},
    Row{"crease", "--crease X", 1, "on curved surfaces edges sharper than X degrees stay (default 40; 180: none)"},
    Row{"for", "--for READER", 1,
        "what a reader needs: dealii, mfem, dolfinx, elmer, su2, calculix, abaqus, openfoam, specfem2d"},
    Row{"elements", "--elements NAME", 1,
        "for decks: CPS (default in the plane z = 0), CPE, CAX, S (elsewhere), M3D, or CPSR, ..."},
    Row{"stats", "--stats FILE", 1, "write the figures of the result to FILE (JSON)"},
    Row{"report", "--report FILE", 1, "write a page that shows the mesh before and after, and all figures (HTML)"},
    Row{"film", "--film FILE", 1, "write a page that plays how the front advanced, step by step (HTML)"},
    Row{"depfile", "--depfile FILE", 1, "write a rule for make: every file that OUT depends on"},
    Row{"svg", "--svg FILE", 1, "write a picture of the mesh"},
    Row{"pdf", "--pdf FILE", 1, "the same as PDF"},
    Row{"tikz", "--tikz FILE", 1, "the same for LaTeX (TikZ)"},
    Row{"stage", "--stage NAME", 1, "for pictures: input, front, elimination, smoothing, cleanup or final (default)"},
    Row{"colour", "--colour NAME", 1, "for pictures: sj (scaled Jacobian, default), eta, thesis, size or none"},
    Row{"from", "--from WHERE", 1,
        "for pictures, and pages in space: seen from x, y or z, with a minus from the other side, or from X,Y,Z"},
    Row{"views", "--views", 0, "write the figures into OUT as data that Gmsh shows, or beside it (.pos)"},
    Row{"view", "--view", 0, "show OUT in Gmsh's window"},
    Row{"gui", "--gui", 0, "Gmsh's window on IN, or on nothing, with a panel: convert, back, step by step, save"},
    Row{"smoothing", "--smoothing NAME", 1, "shape_energy (default), or thesis: constrained Laplacian"},
    Row{"set", "--set NAME=VALUE", 1, "set a constant of the algorithm (README: \"Constants\")"},
    Row{"check", "--check", 0, "judge the mesh IN and write nothing: status 6 if it is not good enough"},
    Row{"min-sj", "--min-sj X", 1, "for --check: every scaled Jacobian above X (default 0)"},
    Row{"max-irregular", "--max-irregular X", 1, "for --check: irregular share of interior nodes at most X (0 to 1)"},
    Row{"no-triangles", "--no-triangles", 0, "for --check: not one triangle"},
    Row{"against", "--against FILE", 1, "for --check: the triangles that IN was made from, to compare with"},
    Row{"max-distance", "--max-distance X", 1, "for --check: nowhere farther from them than X edges"},
    Row{"max-size-ratio", "--max-size-ratio X", 1,
        "for --check: quads at most X times as long, or as short, as they are"},
    Row{"help", "--help", 0, "show this text"},
    Row{"version", "--version", 0, "show the version"},
};

}  // namespace

std::span<const Row> our_options() { return kRows; }

std::optional<Option> look_up(std::string_view word) {
  const std::size_t dashes = word.substr(0, 2) == "--" ? 2 : word.substr(0, 1) == "-" ? 1 : 0;
  if (dashes == 0 || word == "-") return std::nullopt;
  const std::string_view name = word.substr(dashes);
  const GmshOptionRow* gmsh = find_gmsh_option(name);
  // Gmsh has a -check of its own, which is not ours.
  if (dashes == 1 && gmsh) return Option{nullptr, gmsh};
  for (const Row& row : kRows)
    if (row.name == name) return Option{&row, nullptr};
  if (gmsh) return Option{nullptr, gmsh};
  return std::nullopt;
}

std::optional<Option> find_option(std::string_view word) {
  auto option = look_up(word);
  if (!option && word.size() > 1 && word[0] == '-') throw UsageError(fmt::format("unknown option '{}'", word));
  return option;
}

}  // namespace qmorph::cli
