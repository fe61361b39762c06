// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/request/gmsh_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "cli/request/value.hpp"
#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

using enum GmshOption;
using Row = GmshOptionRow;

constexpr std::string_view kElsewhere = "do that with gmsh, before or after";

/// Gmsh's reference manual, appendix on the command line.
constexpr std::array kRows = {
    Row{"clmin", 1, passed, "positive"},
    Row{"clmax", 1, passed, "positive"},
    Row{"clscale", 1, passed, "positive"},
    Row{"clextend", 1, passed, "number"},
    Row{"clcurv", 1, passed, "number"},
    Row{"algo", 1, passed, "algorithm"},
    Row{"smooth", 1, passed, "number"},
    Row{"order", 1, passed, "positive"},
    Row{"degree", 1, passed, "positive"},
    Row{"epslc1d", 1, passed, "number"},
    Row{"swapangle", 1, passed, "number"},
    Row{"rand", 1, passed, "number"},
    Row{"aniso_max", 1, passed, "number"},
    Row{"smooth_ratio", 1, passed, "number"},
    Row{"edgelmin", 1, passed, "number"},
    Row{"tol", 1, passed, "number"},
    Row{"scale", 1, passed, "number"},
    Row{"meshscale", 1, passed, "number"},
    Row{"match", 0, passed, ""},
    Row{"save_all", 0, passed, ""},
    Row{"saveall", 0, passed, ""},
    Row{"save_parametric", 0, passed, ""},
    Row{"parametric", 0, passed, ""},
    Row{"save_topology", 0, passed, ""},
    Row{"save_entities", 0, passed, ""},
    Row{"preserve_numbering_msh2", 0, passed, ""},
    Row{"switch_tags", 0, passed, ""},
    Row{"ignore_periodicity", 0, passed, ""},
    Row{"optimize", 0, passed, ""},
    Row{"optimize_threshold", 1, passed, "number"},
    Row{"optimize_netgen", 0, passed, ""},
    Row{"optimize_ho", 0, passed, ""},
    Row{"ho_min", 1, passed, "number"},
    Row{"ho_max", 1, passed, "number"},
    Row{"ho_nlayers", 1, passed, "number"},
    Row{"part_topo", 0, passed, ""},
    Row{"part_no_topo", 0, passed, ""},
    Row{"part_topo_pro", 0, passed, ""},
    Row{"part_physicals", 0, passed, ""},
    Row{"part_no_physicals", 0, passed, ""},
    Row{"setnumber", 2, passed, "pair"},
    Row{"setstring", 2, passed, "text"},
    Row{"setlist", -1, passed, "text"},
    Row{"string", 1, passed, "text"},
    Row{"option", 1, passed, "text"},
    Row{"bgm", 1, passed, "text"},

    Row{"quad", 0, nothing, ""},
    Row{"merge", 0, nothing, ""},
    Row{"cpu", 0, nothing, ""},
    Row{"nopopup", 0, nothing, ""},
    Row{"noenv", 0, nothing, ""},
    Row{"nolocale", 0, nothing, ""},
    Row{"n", 0, nothing, ""},
    Row{"nodb", 0, nothing, ""},
    Row{"fontsize", 1, nothing, ""},
    Row{"deltafontsize", 1, nothing, ""},
    Row{"theme", 1, nothing, ""},
    Row{"display", 1, nothing, ""},
    Row{"camera", 0, nothing, ""},
    Row{"stereo", 0, nothing, ""},
    Row{"gamepad", 0, nothing, ""},
    Row{"a", 0, nothing, ""},
    Row{"g", 0, nothing, ""},
    Row{"m", 0, nothing, ""},
    Row{"s", 0, nothing, ""},
    Row{"p", 0, nothing, ""},
    Row{"link", 1, nothing, ""},
    Row{"combine", 0, nothing, ""},
    Row{"smoothview", 0, nothing, ""},
    Row{"bg", 1, nothing, ""},
    Row{"numsubedges", 1, nothing, ""},
    Row{"tiles", 1, nothing, ""},
    Row{"windows", 1, nothing, ""},

    Row{"0", 0, refused, "the unrolled geometry has no quads"},
    Row{"1", 0, refused, "quads need surfaces: -2 or -3"},
    Row{"parse_and_exit", 0, refused, "it writes nothing"},
    Row{"refine", 0, refused, kElsewhere},
    Row{"barycentric_refine", 0, refused, kElsewhere},
    Row{"reclassify", 1, refused, kElsewhere},
    Row{"reparam", 1, refused, kElsewhere},
    Row{"check", 0, refused, "--check, with two dashes, judges a mesh"},
    Row{"convert", 0, refused, kElsewhere},
    Row{"part_weight", 2, refused, "-setnumber Mesh.PartitionQuadWeight N, and so on for other elements"},
    Row{"part_split", 0, refused, "the mesh goes into one file"},
    Row{"part_ghosts", 0, refused, "ghost cells are made by gmsh -part_ghosts from the quads"},
    Row{"part_no_ghosts", 0, nothing, ""},
    Row{"overlap", 1, refused, "overlaps are made by gmsh -overlap from the quads"},
    Row{"new", 0, refused, "one model at a time"},
    Row{"open", 0, refused, "one model at a time; further files are merged"},
    Row{"log", 1, refused, "messages go to the standard error: 2> FILE"},
    Row{"pid", 0, refused, "the shell knows it"},
    Row{"watch", 1, refused, "it is for the window"},
    Row{"listen", 1, refused, "it is for solvers of the window"},
    Row{"minterpreter", 1, refused, "it is for solvers of the window"},
    Row{"pyinterpreter", 1, refused, "it is for solvers of the window"},
    Row{"run", 0, refused, "it is for solvers of the window"},
    Row{"info", 0, refused, "gmsh -info says it"},
    Row{"help_options", 0, refused, "gmsh -help_options says it"},
};

/// Gmsh's names. Gmsh prints a complaint about others and goes on, which nobody would see.
constexpr std::array<std::string_view, 21> kAlgorithms = {
    "auto",    "meshadapt", "iso",     "del2d", "tri",     "delaunay",   "front2d",
    "frontal", "bamg",      "delquad", "pack",  "quadqs",  "frontopt2d", "initial2d",
    "del3d",   "front3d",   "netgen",  "mmg3d", "rtree3d", "hxt",        "initial3d"};

/// What matters only where Gmsh makes elements.
constexpr std::array<std::string_view, 17> kMeshing = {
    "clmin",    "clmax",   "clscale",        "clextend",       "clcurv",           "algo",
    "smooth",   "epslc1d", "swapangle",      "rand",           "aniso_max",        "smooth_ratio",
    "edgelmin", "bgm",     "Mesh.Algorithm", "Mesh.Smoothing", "Mesh.RandomFactor"};

bool is_number(const std::string& text) {
  const auto number = to_number(text);
  return number && std::isfinite(*number);
}

}  // namespace

const GmshOptionRow* find_gmsh_option(std::string_view name) {
  const auto* found = std::find_if(kRows.begin(), kRows.end(), [&](const Row& row) { return row.name == name; });
  return found == kRows.end() ? nullptr : found;
}

void check_gmsh_values(const GmshOptionRow& row, const std::vector<std::string>& values) {
  const auto refuse = [&](std::string_view what) {
    throw UsageError(fmt::format("-{}: '{}' is not {}", row.name, values.back(), what));
  };
  if (row.note == "pair" && !is_number(values[1])) refuse("a number");
  if (row.note == "number" && !is_number(values[0])) refuse("a number");
  if (row.note == "positive" && (!is_number(values[0]) || std::stod(values[0]) <= 0)) refuse("a positive number");
  if (row.note != "algorithm") return;
  std::string name = values[0];
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (std::find(kAlgorithms.begin(), kAlgorithms.end(), name) == kAlgorithms.end())
    refuse("an algorithm of Gmsh (front2d, del2d, meshadapt, delquad, pack, ...)");
}

bool says_how_to_mesh(std::string_view name) {
  const auto begins_with = [&](std::string_view start) { return name.substr(0, start.size()) == start; };
  return std::find(kMeshing.begin(), kMeshing.end(), name) != kMeshing.end() || begins_with("Mesh.MeshSize") ||
         begins_with("Mesh.CharacteristicLength");
}

std::string passed_gmsh_options() {
  std::string text;
  for (const Row& row : kRows)
    if (row.kind == passed) text += fmt::format("{}-{}", text.empty() ? "" : " ", row.name);
  return text;
}

}  // namespace qmorph::cli
