#include "cli/request.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

/// Gmsh's own default: everything but debugging.
constexpr int kDefaultVerbosity = 5;

enum class For { kUs, kGmsh };

/// One option. Gmsh writes long names with one dash, CLI11 with two: this table knows both, and how many words follow.
struct Row {
  std::string_view name;      ///< without dashes
  std::string_view spelling;  ///< as --help shows it
  int values;
  For reader;
  std::string_view help;
};

constexpr std::array kRows = {
    Row{"o", "-o FILE", 1, For::kUs, "write to FILE; without it: IN with the extension of the format"},
    Row{"format", "-format NAME", 1, For::kUs,
        "msh, msh2, msh4, vtk, inp, su2, unv, bdf, mesh, ...; wins over the extension of FILE"},
    Row{"bin", "-bin", 0, For::kUs, "binary output, for formats that have it"},
    Row{"clmin", "-clmin SIZE", 1, For::kGmsh, "smallest size of the triangles that Gmsh makes"},
    Row{"clmax", "-clmax SIZE", 1, For::kGmsh, "largest size"},
    Row{"clscale", "-clscale F", 1, For::kGmsh, "all sizes times F"},
    Row{"algo", "-algo NAME", 1, For::kGmsh,
        "Gmsh's algorithm for the triangles: front2d (default), del2d, meshadapt, delquad, pack, ..."},
    Row{"setnumber", "-setnumber NAME V", 2, For::kGmsh, "set a constant of the script or an option of Gmsh"},
    Row{"setstring", "-setstring NAME S", 2, For::kGmsh, "the same for text"},
    Row{"2", "-2", 0, For::kUs, "surfaces, which is what it does anyway"},
    Row{"nt", "-nt N", 1, For::kUs, "threads; the result does not depend on it"},
    Row{"v", "-v N", 1, For::kUs, "0: errors only, 1: and the summary, 2 and more: and Gmsh's warnings (default 5)"},
    Row{"surfaces", "--surfaces T,T,...", 1, For::kUs, "convert the surfaces with these tags only"},
    Row{"cleanup-only", "--cleanup-only", 0, For::kUs,
        "improve quads, by Gmsh or anyone, that are there already; triangles among them are paired"},
    Row{"stats", "--stats FILE", 1, For::kUs, "write the figures of the result to FILE (JSON)"},
    Row{"set", "--set NAME=VALUE", 1, For::kUs, "set a constant of the algorithm (README: \"Constants\")"},
    Row{"help", "--help", 0, For::kUs, "show this text"},
    Row{"version", "--version", 0, For::kUs, "show the version"},
};

constexpr std::string_view kHelpHead =
    R"(qmorph IN [-o OUT] [options]

Turns the triangles of a Gmsh model into quads (Q-Morph). IN is anything that Gmsh opens: a
geometry (.geo, .step, .brep, ...), which Gmsh meshes with triangles first, or a mesh (.msh of any
version, with or without a geometry), which is taken as it is. Boundaries, curves, points, physical
groups and tags stay. Takes what a "gmsh -2" line of a Makefile takes.

)";

constexpr std::string_view kHelpTail = R"(
Exit status:
  0  every surface (or every one of --surfaces) consists of quads, but for one triangle in each
     region with an odd number of sides
  1  the command line makes no sense
  2  the input cannot be opened or meshed; nothing has been written
  3  converted in part: OUT has been written, and the surfaces that are named on stderr are in it as
     they were
  4  nothing to convert: all surfaces are quads already (OUT has been written, with the mesh of IN
     as it was), or there are no surfaces (nothing has been written)
  5  OUT cannot be written; a previous file of that name is as it was
)";

/// Gmsh's names (notes 3.2). Gmsh prints a complaint about others and goes on, which nobody would see.
constexpr std::array<std::string_view, 21> kAlgorithms = {
    "auto",    "meshadapt", "iso",     "del2d", "tri",     "delaunay",   "front2d",
    "frontal", "bamg",      "delquad", "pack",  "quadqs",  "frontopt2d", "initial2d",
    "del3d",   "front3d",   "netgen",  "mmg3d", "rtree3d", "hxt",        "initial3d"};

bool is_number(const std::string& text) {
  double value = 0;
  return CLI::detail::lexical_cast(text, value) && std::isfinite(value);
}

const Row* find_row(std::string_view word) {
  const std::size_t dashes = word.substr(0, 2) == "--" ? 2 : word.substr(0, 1) == "-" ? 1 : 0;
  if (dashes == 0) return nullptr;
  for (const Row& row : kRows)
    if (row.name == word.substr(dashes)) return &row;
  throw UsageError(fmt::format("unknown option '{}'", word));
}

/// Values that Gmsh would only complain about, or silently take for 0.
void check_gmsh_values(const Row& row, const std::vector<std::string>& values) {
  const auto refuse = [&](std::string_view what) {
    throw UsageError(fmt::format("-{}: '{}' is not {}", row.name, values.back(), what));
  };
  if (row.name == "setnumber" && !is_number(values[1])) refuse("a number");
  if (row.name.substr(0, 2) == "cl" && (!is_number(values[0]) || std::stod(values[0]) <= 0))
    refuse("a positive number");
  if (row.name != "algo") return;
  std::string name = values[0];
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (std::find(kAlgorithms.begin(), kAlgorithms.end(), name) == kAlgorithms.end())
    refuse("an algorithm of Gmsh (front2d, del2d, meshadapt, delquad, pack, ...)");
}

double msh_version(const std::string& text) {
  constexpr std::array kVersions = {1.0, 2.0, 2.1, 2.2, 3.0, 4.0, 4.1};
  const double version = std::stod(text);
  if (std::find(kVersions.begin(), kVersions.end(), version) == kVersions.end())
    throw UsageError(fmt::format("Mesh.MshFileVersion: there is no version '{}' (1, 2.2, 3, 4, 4.1)", text));
  return version;
}

void note_gmsh_option(const Row& row, const std::vector<std::string>& values, Request& request) {
  check_gmsh_values(row, values);
  request.gmsh_arguments.push_back(fmt::format("-{}", row.name));
  request.gmsh_arguments.insert(request.gmsh_arguments.end(), values.begin(), values.end());
  if (row.name == "algo") request.algorithm_chosen = true;
  // Names without a dot are constants of the script.
  if (values[0].find('.') != std::string::npos && row.values == 2) request.option_names.push_back(values[0]);
  if (row.name != "setnumber") return;
  if (values[0] == "Mesh.Algorithm") request.algorithm_chosen = true;
  if (values[0] == "Mesh.MshFileVersion") request.msh_version = msh_version(values[1]);
  if (values[0] == "Mesh.Binary") request.binary = std::stod(values[1]) != 0;
}

/// Takes out what is Gmsh's and gives the rest CLI11's spelling.
std::vector<std::string> translate(const std::vector<std::string>& arguments, Request& request) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    // --name=value is the spelling of other programs; let it be ours as well.
    const std::size_t equals = arguments[i].substr(0, 2) == "--" ? arguments[i].find('=') : std::string::npos;
    const Row* row = find_row(arguments[i].substr(0, equals));
    if (!row) {
      words.push_back(arguments[i]);
      continue;
    }
    const std::string& word = arguments[i];
    std::vector<std::string> values;
    if (equals != std::string::npos) values.push_back(arguments[i].substr(equals + 1));
    while (static_cast<int>(values.size()) < row->values && i + 1 < arguments.size()) values.push_back(arguments[++i]);
    if (static_cast<int>(values.size()) != row->values)
      throw UsageError(fmt::format("'{}' needs {} value{}", word, row->values, row->values == 1 ? "" : "s"));
    // CLI11 would take the next word in its place.
    if (row->reader == For::kUs && row->values == 1 && values[0].empty())
      throw UsageError(fmt::format("{} needs a value", row->spelling.substr(0, row->spelling.find(' '))));
    if (row->reader == For::kGmsh)
      note_gmsh_option(*row, values, request);
    else
      words.push_back(values.empty() ? fmt::format("--{}", row->name) : fmt::format("--{}={}", row->name, values[0]));
  }
  return words;
}

/// What CLI11 says, with the names as --help shows them.
std::string with_our_spelling(std::string message) {
  for (const Row& row : kRows) {
    if (row.spelling.substr(0, 2) == "--") continue;
    const std::string theirs = fmt::format("--{}", row.name);
    for (std::size_t at = 0; (at = message.find(theirs, at)) != std::string::npos; ++at) {
      const std::size_t end = at + theirs.size();
      if (end == message.size() || !std::isalnum(static_cast<unsigned char>(message[end]))) message.erase(at, 1);
    }
  }
  return message;
}

int surface_tag(const std::string& text) {
  int tag = 0;
  if (!CLI::detail::lexical_cast(text, tag) || tag < 0)
    throw UsageError(fmt::format(
        "--surfaces: '{}' is not a tag; give the numbers of surfaces, as 3,7 (not of groups, nor names)", text));
  return tag;
}

}  // namespace

Request parse(const std::vector<std::string>& arguments) {
  Request request;
  request.verbosity = kDefaultVerbosity;
  std::vector<std::string> words = translate(arguments, request);

  CLI::App app;
  app.set_help_flag();
  bool ignored_flag = false, binary = false;
  int threads = 0;
  app.add_option("IN", request.input);
  app.add_option("--o", request.output);
  app.add_option("--format", request.format);
  app.add_flag("--bin", binary);
  app.add_flag("--2", ignored_flag);
  app.add_option("--nt", threads)->check(CLI::NonNegativeNumber);
  app.add_option("--v", request.verbosity)->check(CLI::NonNegativeNumber);
  std::vector<std::string> surfaces;
  app.add_option("--surfaces", surfaces)->delimiter(',')->allow_extra_args(false);
  app.add_flag("--cleanup-only", request.cleanup_only);
  app.add_option("--stats", request.stats);
  app.add_option("--set", request.settings)->allow_extra_args(false);
  app.add_flag("--help", request.help);
  app.add_flag("--version", request.version);
  std::reverse(words.begin(), words.end());  // CLI11 takes them from the back
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    throw UsageError(with_our_spelling(error.what()));
  }
  if (request.help || request.version) return request;
  if (request.input.empty()) throw UsageError("which file? (qmorph IN [-o OUT])");
  if (binary) request.binary = true;
  for (const std::string& tag : surfaces) request.surfaces.push_back(surface_tag(tag));
  return request;
}

std::string help_text() {
  std::string text(kHelpHead);
  for (const Row& row : kRows) text += fmt::format("  {:<20} {}\n", row.spelling, row.help);
  return text + std::string(kHelpTail);
}

}  // namespace qmorph::cli
