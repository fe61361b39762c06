#include "cli/gmsh_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

constexpr auto kPassed = GmshOption::kPassed;
constexpr auto kNothing = GmshOption::kNothing;
constexpr auto kRefused = GmshOption::kRefused;
using Row = GmshOptionRow;

constexpr std::string_view kElsewhere = "do that with gmsh, before or after";

/// Gmsh's reference manual, appendix on the command line.
constexpr std::array kRows = {
    Row{"clmin", 1, kPassed, "positive"},
    Row{"clmax", 1, kPassed, "positive"},
    Row{"clscale", 1, kPassed, "positive"},
    Row{"clextend", 1, kPassed, "number"},
    Row{"clcurv", 1, kPassed, "number"},
    Row{"algo", 1, kPassed, "algorithm"},
    Row{"smooth", 1, kPassed, "number"},
    Row{"order", 1, kPassed, "positive"},
    Row{"degree", 1, kPassed, "positive"},
    Row{"epslc1d", 1, kPassed, "number"},
    Row{"swapangle", 1, kPassed, "number"},
    Row{"rand", 1, kPassed, "number"},
    Row{"aniso_max", 1, kPassed, "number"},
    Row{"smooth_ratio", 1, kPassed, "number"},
    Row{"edgelmin", 1, kPassed, "number"},
    Row{"tol", 1, kPassed, "number"},
    Row{"scale", 1, kPassed, "number"},
    Row{"meshscale", 1, kPassed, "number"},
    Row{"match", 0, kPassed, ""},
    Row{"save_all", 0, kPassed, ""},
    Row{"saveall", 0, kPassed, ""},
    Row{"save_parametric", 0, kPassed, ""},
    Row{"parametric", 0, kPassed, ""},
    Row{"save_topology", 0, kPassed, ""},
    Row{"save_entities", 0, kPassed, ""},
    Row{"preserve_numbering_msh2", 0, kPassed, ""},
    Row{"switch_tags", 0, kPassed, ""},
    Row{"ignore_periodicity", 0, kPassed, ""},
    Row{"optimize", 0, kPassed, ""},
    Row{"optimize_threshold", 1, kPassed, "number"},
    Row{"optimize_netgen", 0, kPassed, ""},
    Row{"optimize_ho", 0, kPassed, ""},
    Row{"ho_min", 1, kPassed, "number"},
    Row{"ho_max", 1, kPassed, "number"},
    Row{"ho_nlayers", 1, kPassed, "number"},
    Row{"part_topo", 0, kPassed, ""},
    Row{"part_no_topo", 0, kPassed, ""},
    Row{"part_topo_pro", 0, kPassed, ""},
    Row{"part_physicals", 0, kPassed, ""},
    Row{"part_no_physicals", 0, kPassed, ""},
    Row{"setnumber", 2, kPassed, "pair"},
    Row{"setstring", 2, kPassed, "text"},
    Row{"setlist", -1, kPassed, "text"},
    Row{"string", 1, kPassed, "text"},
    Row{"option", 1, kPassed, "text"},
    Row{"bgm", 1, kPassed, "text"},

    Row{"quad", 0, kNothing, ""},
    Row{"merge", 0, kNothing, ""},
    Row{"cpu", 0, kNothing, ""},
    Row{"nopopup", 0, kNothing, ""},
    Row{"noenv", 0, kNothing, ""},
    Row{"nolocale", 0, kNothing, ""},
    Row{"n", 0, kNothing, ""},
    Row{"nodb", 0, kNothing, ""},
    Row{"fontsize", 1, kNothing, ""},
    Row{"deltafontsize", 1, kNothing, ""},
    Row{"theme", 1, kNothing, ""},
    Row{"display", 1, kNothing, ""},
    Row{"camera", 0, kNothing, ""},
    Row{"stereo", 0, kNothing, ""},
    Row{"gamepad", 0, kNothing, ""},
    Row{"a", 0, kNothing, ""},
    Row{"g", 0, kNothing, ""},
    Row{"m", 0, kNothing, ""},
    Row{"s", 0, kNothing, ""},
    Row{"p", 0, kNothing, ""},
    Row{"link", 1, kNothing, ""},
    Row{"combine", 0, kNothing, ""},
    Row{"smoothview", 0, kNothing, ""},
    Row{"bg", 1, kNothing, ""},
    Row{"numsubedges", 1, kNothing, ""},
    Row{"tiles", 1, kNothing, ""},
    Row{"windows", 1, kNothing, ""},

    Row{"0", 0, kRefused, "the unrolled geometry has no quads"},
    Row{"1", 0, kRefused, "quads need surfaces: -2 or -3"},
    Row{"parse_and_exit", 0, kRefused, "it writes nothing"},
    Row{"refine", 0, kRefused, kElsewhere},
    Row{"barycentric_refine", 0, kRefused, kElsewhere},
    Row{"reclassify", 1, kRefused, kElsewhere},
    Row{"reparam", 1, kRefused, kElsewhere},
    Row{"check", 0, kRefused, "--check, with two dashes, judges a mesh"},
    Row{"convert", 0, kRefused, kElsewhere},
    Row{"part_weight", 2, kRefused, "-setnumber Mesh.PartitionQuadWeight N, and so on for other elements"},
    Row{"part_split", 0, kRefused, "the mesh goes into one file"},
    Row{"part_ghosts", 0, kRefused, "ghost cells are made by gmsh -part_ghosts from the quads"},
    Row{"part_no_ghosts", 0, kNothing, ""},
    Row{"overlap", 1, kRefused, "overlaps are made by gmsh -overlap from the quads"},
    Row{"new", 0, kRefused, "one model at a time"},
    Row{"open", 0, kRefused, "one model at a time; further files are merged"},
    Row{"log", 1, kRefused, "messages go to the standard error: 2> FILE"},
    Row{"pid", 0, kRefused, "the shell knows it"},
    Row{"watch", 1, kRefused, "it is for the window"},
    Row{"listen", 1, kRefused, "it is for solvers of the window"},
    Row{"minterpreter", 1, kRefused, "it is for solvers of the window"},
    Row{"pyinterpreter", 1, kRefused, "it is for solvers of the window"},
    Row{"run", 0, kRefused, "it is for solvers of the window"},
    Row{"info", 0, kRefused, "gmsh -info says it"},
    Row{"help_options", 0, kRefused, "gmsh -help_options says it"},
};

/// Gmsh's names. Gmsh prints a complaint about others and goes on, which nobody would see.
constexpr std::array<std::string_view, 21> kAlgorithms = {
    "auto",    "meshadapt", "iso",     "del2d", "tri",     "delaunay",   "front2d",
    "frontal", "bamg",      "delquad", "pack",  "quadqs",  "frontopt2d", "initial2d",
    "del3d",   "front3d",   "netgen",  "mmg3d", "rtree3d", "hxt",        "initial3d"};

/// What means something only where Gmsh makes elements.
constexpr std::array<std::string_view, 17> kMeshing = {
    "clmin",   "clmax",     "clscale",      "clextend", "clcurv", "algo",           "smooth",         "epslc1d", "swapangle",
    "rand",    "aniso_max", "smooth_ratio", "edgelmin", "bgm",    "Mesh.Algorithm", "Mesh.Smoothing", "Mesh.RandomFactor"};

bool is_number(const std::string& text) {
  double value = 0;
  return CLI::detail::lexical_cast(text, value) && std::isfinite(value);
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
    if (row.kind == kPassed) text += fmt::format("{}-{}", text.empty() ? "" : " ", row.name);
  return text;
}

}  // namespace qmorph::cli
