// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/request/options.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

using enum Use;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

void append(std::vector<int>& all, const std::vector<int>& more) { all.insert(all.end(), more.begin(), more.end()); }

bool is_on(const Value& value) {
  if (value.text != "on" && value.text != "off")
    throw UsageError(fmt::format("{} is on or off, not '{}'", value.option, value.text));
  return value.text == "on";
}

// r: the request, v: the word behind the option.
constexpr std::array kOptions = {
    OurOption{"o", "-o FILE", once,
              "write to FILE; without it: IN with the extension of the format; -: standard output",
              [](Request& r, const Value& v) { r.output = v.text; }},
    OurOption{"format", "-format NAME", once,
              "msh, msh2, msh4, vtk, inp, su2, unv, bdf, mesh, ...; wins over the extension of FILE",
              [](Request& r, const Value& v) { r.format = v.text; }},
    OurOption{"bin", "-bin", flag, "binary output, for formats that have it",
              [](Request& r, const Value&) { r.binary = true; }},
    OurOption{"2", "-2", flag, "surfaces, which is what it does anyway", [](Request&, const Value&) {}},
    OurOption{"3", "-3", flag, "then volumes on the quads, by Gmsh: pyramids and tetrahedra",
              [](Request& r, const Value&) { r.dimension = 3; }},
    OurOption{"save", "-save", flag, "do not mesh: convert what is there",
              [](Request& r, const Value&) { r.no_meshing = true; }},
    OurOption{"part", "-part N", once, "cut the result into N partitions",
              [](Request& r, const Value& v) { r.partitions = count_in(v); }},
    OurOption{"nt", "-nt N", once, "threads (default: all of the machine); the result does not depend on it",
              [](Request& r, const Value& v) { r.threads = count_in(v); }},
    OurOption{"v", "-v N", once, "0: errors only, 1: and the summary, 2 and more: and Gmsh's warnings (default 5)",
              [](Request& r, const Value& v) { r.verbosity = count_in(v); }},
    OurOption{"surfaces", "--surfaces T,T,...", repeated, "convert the surfaces with these tags only",
              [](Request& r, const Value& v) { append(r.surfaces, tags_in(v, "surfaces")); }},
    OurOption{"drop-volumes", "--drop-volumes", flag, "remove volume elements, so that their surfaces may become quads",
              [](Request& r, const Value&) { r.drop_volumes = true; }},
    OurOption{"all-quad", "--all-quad", flag,
              "no triangle at all: where a boundary is odd, as few curve segments as possible get a node",
              [](Request& r, const Value&) { r.all_quad = true; }},
    OurOption{"keep-curves", "--keep-curves T,...", repeated,
              "curves with these tags get none; those of a geometry have Gmsh's number of segments",
              [](Request& r, const Value& v) { append(r.keep_curves, tags_in(v, "curves")); }},
    OurOption{"cleanup-only", "--cleanup-only", flag,
              "improve quads, by Gmsh or anyone, that are there already; triangles among them are paired",
              [](Request& r, const Value&) { r.cleanup_only = true; }},
    OurOption{"orient", "--orient", flag,
              "turn elements so that neighbours agree; counterclockwise where the model is flat",
              [](Request& r, const Value&) { r.orient = true; }},
    OurOption{"layers", "--layers on|off", once,
              "on (default): keep rows of triangles along walls, grids, and how triangles are stretched",
              [](Request& r, const Value& v) { r.layers = is_on(v); }},
    OurOption{"crease", "--crease X", once,
              "edges of curved surfaces sharper than X degrees stay (40; 180: none), unless their geometry is smooth",
              [](Request& r, const Value& v) { r.crease = number_in(v, 0, 180); }},
    OurOption{"for", "--for READER", once,
              "what a reader needs: dealii, mfem, dolfinx, elmer, su2, calculix, abaqus, openfoam, specfem2d",
              [](Request& r, const Value& v) { r.consumer = v.text; }},
    OurOption{"elements", "--elements NAME", once,
              "for decks: CPS (default in the plane z = 0), CPE, CAX, S (elsewhere), M3D, or CPSR, ...",
              [](Request& r, const Value& v) { r.elements = v.text; }},
    OurOption{"stats", "--stats FILE", once, "write the figures of the result to FILE (JSON)",
              [](Request& r, const Value& v) { r.stats = v.text; }},
    OurOption{"report", "--report FILE", once,
              "write a page that shows the mesh before and after, and all figures (HTML)",
              [](Request& r, const Value& v) { r.report = v.text; }},
    OurOption{"film", "--film FILE", once, "write a page that plays how the front advanced, step by step (HTML)",
              [](Request& r, const Value& v) { r.film = v.text; }},
    OurOption{"depfile", "--depfile FILE", once, "write a rule for make: every file that OUT depends on",
              [](Request& r, const Value& v) { r.depfile = v.text; }},
    OurOption{"svg", "--svg FILE", once, "write a picture of the mesh",
              [](Request& r, const Value& v) { r.svg = v.text; }},
    OurOption{"pdf", "--pdf FILE", once, "the same as PDF", [](Request& r, const Value& v) { r.pdf = v.text; }},
    OurOption{"tikz", "--tikz FILE", once, "the same for LaTeX (TikZ)",
              [](Request& r, const Value& v) { r.tikz = v.text; }},
    OurOption{"stage", "--stage NAME", once,
              "for pictures: input, front, elimination, smoothing, cleanup or final (default)",
              [](Request& r, const Value& v) { r.stage = v.text; }},
    OurOption{"colour", "--colour NAME", once, "for pictures: sj (scaled Jacobian, default), eta, thesis, size or none",
              [](Request& r, const Value& v) { r.colour = v.text; }},
    OurOption{"from", "--from WHERE", once,
              "for pictures, and pages in space: seen from x, y or z, with a minus from the other side, or from X,Y,Z",
              [](Request& r, const Value& v) { r.from = v.text; }},
    OurOption{"views", "--views", flag, "write the figures into OUT as data that Gmsh shows, or beside it (.pos)",
              [](Request& r, const Value&) { r.views = true; }},
    OurOption{"view", "--view", flag, "show OUT in Gmsh's window", [](Request& r, const Value&) { r.view = true; }},
    OurOption{"gui", "--gui", flag,
              "Gmsh's window on IN, or on nothing, with a panel: convert, back, step by step, save",
              [](Request& r, const Value&) { r.gui = true; }},
    OurOption{"smoothing", "--smoothing NAME", once, "shape_energy (default), or thesis: constrained Laplacian",
              [](Request& r, const Value& v) { r.smoothing = v.text; }},
    OurOption{"set", "--set NAME=VALUE", repeated,
              "set a constant of the algorithm; a NAME that there is not lists them all",
              [](Request& r, const Value& v) { r.settings.push_back(v.text); }},
    OurOption{"check", "--check", flag, "judge the mesh IN and write nothing: status 6 if it is not good enough",
              [](Request& r, const Value&) { r.check = true; }},
    OurOption{"min-sj", "--min-sj X", once, "for --check: every scaled Jacobian above X (default 0)",
              [](Request& r, const Value& v) { r.thresholds.min_scaled_jacobian = number_in(v, -1, 1); }},
    OurOption{"max-irregular", "--max-irregular X", once,
              "for --check: irregular share of interior nodes at most X (0 to 1)",
              [](Request& r, const Value& v) { r.thresholds.max_irregular = number_in(v, 0, 1); }},
    OurOption{"no-triangles", "--no-triangles", flag, "for --check: not one triangle",
              [](Request& r, const Value&) { r.thresholds.no_triangles = true; }},
    OurOption{"against", "--against FILE", once, "for --check: the triangles that IN was made from, to compare with",
              [](Request& r, const Value& v) { r.against = v.text; }},
    OurOption{"max-distance", "--max-distance X", once, "for --check: nowhere farther from them than X edges",
              [](Request& r, const Value& v) { r.thresholds.max_distance = number_in(v, 0, kNoLimit); }},
    OurOption{"max-size-ratio", "--max-size-ratio X", once,
              "for --check: quads at most X times as long, or as short, as they are",
              [](Request& r, const Value& v) { r.thresholds.max_size_ratio = number_in(v, 1, kNoLimit); }},
    OurOption{"help", "--help", flag, "show this text", [](Request& r, const Value&) { r.help = true; }},
    OurOption{"version", "--version", flag, "show the version", [](Request& r, const Value&) { r.version = true; }},
};

}  // namespace

std::span<const OurOption> our_options() { return kOptions; }

std::optional<Option> look_up(std::string_view word) {
  const std::size_t dashes = word.substr(0, 2) == "--" ? 2 : word.substr(0, 1) == "-" ? 1 : 0;
  if (dashes == 0 || word == "-") return std::nullopt;
  std::string_view name = word.substr(dashes);
  if (name == "f") name = "format";
  if (name == "h") name = "help";
  const GmshOptionRow* gmsh = find_gmsh_option(name);
  // Gmsh has a -check of its own, which is not ours.
  if (dashes == 1 && gmsh) return Option{nullptr, gmsh};
  for (const OurOption& ours : kOptions)
    if (ours.name == name) return Option{&ours, nullptr};
  if (gmsh) return Option{nullptr, gmsh};
  return std::nullopt;
}

std::optional<Option> find_option(std::string_view word) {
  auto option = look_up(word);
  if (!option && word.size() > 1 && word[0] == '-') throw UsageError(fmt::format("unknown option '{}'", word));
  return option;
}

}  // namespace qmorph::cli
