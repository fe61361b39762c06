// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/request.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "cli/gmsh_options.hpp"
#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

/// Gmsh's own default: everything but debugging.
constexpr int kDefaultVerbosity = 5;

/// One option of ours. Gmsh writes long names with one dash, CLI11 with two: this table knows both, and how many
/// words follow. Options without values are flags.
struct Row {
  std::string_view name;      ///< without dashes
  std::string_view spelling;  ///< as --help shows it
  int values;
  std::string_view help;
};

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
    Row{"for", "--for READER", 1,
        "what a reader needs: dealii, mfem, dolfinx, elmer, su2, calculix, abaqus, openfoam, specfem2d"},
    Row{"elements", "--elements NAME", 1, "for decks: CPS (default), CPE, CAX, S or M3D, with an R behind for reduced"},
    Row{"layers", "--layers on|off", 1,
        "on (default): rows of triangles along walls stay rows of quads, with the heights that they have"},
    Row{"stats", "--stats FILE", 1, "write the figures of the result to FILE (JSON)"},
    Row{"report", "--report FILE", 1, "write a page that shows the mesh before and after, and all figures (HTML)"},
    Row{"film", "--film FILE", 1, "write a page that plays how the front advanced, step by step (HTML)"},
    Row{"depfile", "--depfile FILE", 1, "write a rule for make: every file that OUT depends on"},
    Row{"svg", "--svg FILE", 1, "write a picture of the mesh"},
    Row{"pdf", "--pdf FILE", 1, "the same as PDF"},
    Row{"tikz", "--tikz FILE", 1, "the same for LaTeX (TikZ)"},
    Row{"stage", "--stage NAME", 1, "for pictures: input, front, elimination, smoothing, cleanup or final (default)"},
    Row{"colour", "--colour NAME", 1, "for pictures: sj (scaled Jacobian, default), eta, thesis, size or none"},
    Row{"views", "--views", 0, "write the figures into OUT as data that Gmsh shows, or beside it (.pos)"},
    Row{"view", "--view", 0, "show OUT in Gmsh's window"},
    Row{"smoothing", "--smoothing NAME", 1, "shape_energy (default), or thesis: constrained Laplacian"},
    Row{"set", "--set NAME=VALUE", 1, "set a constant of the algorithm (README: \"Constants\")"},
    Row{"check", "--check", 0, "judge the mesh IN and write nothing: status 6 if it is not good enough"},
    Row{"min-sj", "--min-sj X", 1, "for --check: every scaled Jacobian above X (default 0)"},
    Row{"max-irregular", "--max-irregular X", 1, "for --check: irregular share of interior nodes at most X (0 to 1)"},
    Row{"no-triangles", "--no-triangles", 0, "for --check: not one triangle"},
    Row{"against", "--against FILE", 1, "for --check: the triangles that IN was made from, to compare with"},
    Row{"max-distance", "--max-distance X", 1, "for --check: nowhere farther from them than X edges"},
    Row{"max-size-ratio", "--max-size-ratio X", 1, "for --check: quads at most X times as long, or as short, as they are"},
    Row{"help", "--help", 0, "show this text"},
    Row{"version", "--version", 0, "show the version"},
};

constexpr std::string_view kHelpHead =
    R"(qmorph IN [-o OUT] [options]

Turns the triangles of a Gmsh model into quads (Q-Morph). IN is anything that Gmsh opens: a
geometry (.geo, .step, .brep, ...), which Gmsh meshes with triangles first, or a mesh (.msh of any
version, with or without a geometry), which is taken as it is; further files are merged with it;
- is the standard input. Boundaries, curves, points, physical groups and tags stay.

)";

constexpr std::string_view kHelpTail = R"(
Exit status:
  0  every surface (or every one of --surfaces) consists of quads, but for one triangle in each
     region with an odd number of sides; also where it did so before, and nothing was to be done
  1  the command line makes no sense
  2  the input cannot be opened or meshed; nothing has been written
  3  converted in part: OUT has been written, and the surfaces that are named on stderr are in it as
     they were
  4  there are no surfaces with elements; nothing has been written
  5  OUT cannot be written; a previous file of that name is as it was
  6  --check: the mesh is not good enough; --for: the reader would not take it, and nothing has been
     written
)";

/// A word of the command line: one of ours, one of Gmsh's, or neither.
struct Option {
  const Row* ours = nullptr;
  const GmshOptionRow* gmsh = nullptr;
  int values() const { return ours ? ours->values : gmsh->values; }
};

/// Nothing if it is neither.
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

/// Nothing for what is no option, but a file.
std::optional<Option> find_option(std::string_view word) {
  auto option = look_up(word);
  if (!option && word.size() > 1 && word[0] == '-') throw UsageError(fmt::format("unknown option '{}'", word));
  return option;
}

double msh_version(const std::string& text) {
  constexpr std::array kVersions = {1.0, 2.0, 2.1, 2.2, 3.0, 4.0, 4.1};
  const double version = std::stod(text);
  if (std::find(kVersions.begin(), kVersions.end(), version) == kVersions.end())
    throw UsageError(fmt::format("Mesh.MshFileVersion: there is no version '{}' (1, 2.2, 3, 4, 4.1)", text));
  return version;
}

void note_gmsh_option(const GmshOptionRow& row, const std::vector<std::string>& values, Request& request) {
  if (row.kind == GmshOption::refused) throw UsageError(fmt::format("-{}: not here; {}", row.name, row.note));
  if (row.kind == GmshOption::nothing) return;
  check_gmsh_values(row, values);
  request.gmsh_arguments.push_back(fmt::format("-{}", row.name));
  request.gmsh_arguments.insert(request.gmsh_arguments.end(), values.begin(), values.end());
  if (says_how_to_mesh(row.name)) request.meshing_words.push_back(fmt::format("-{}", row.name));
  if (row.name == "algo") request.algorithm_chosen = true;
  if (row.name == "bgm") request.background = values[0];
  if (row.name == "option") request.option_files.push_back(values[0]);
  if (row.name == "ignore_periodicity") request.ignore_periodicity = true;
  if (row.name == "order" || row.name == "degree") request.order_chosen = true;
  if (row.name != "setnumber" && row.name != "setstring") return;
  // Names without a dot are constants of the script.
  if (values[0].find('.') != std::string::npos) request.option_names.push_back(values[0]);
  if (row.name != "setnumber") return;
  if (says_how_to_mesh(values[0])) request.meshing_words.push_back(values[0]);
  if (values[0] == "Mesh.Algorithm") request.algorithm_chosen = true;
  if (values[0] == "Mesh.ElementOrder") request.order_chosen = true;
  if (values[0] == "Mesh.MshFileVersion") request.msh_version = msh_version(values[1]);
  if (values[0] == "Mesh.Binary") request.binary = std::stod(values[1]) != 0;
}

/// The words that follow an option; `at` is the last that belongs to it.
std::vector<std::string> take_values(const std::vector<std::string>& arguments, const Option& option,
                                     const std::optional<std::string>& after_equals, std::size_t& at) {
  const std::string word = arguments[at].substr(0, arguments[at].find('='));
  std::vector<std::string> values;
  if (after_equals) values.push_back(*after_equals);
  int wanted = option.values();
  if (wanted < 0) wanted = 2;  // a name and a count
  while (static_cast<int>(values.size()) < wanted && at + 1 < arguments.size()) {
    double number = 0;  // -3 is an option, but also a number that this option may refuse in its own words
    if (option.values() == 1 && look_up(arguments[at + 1]) && !CLI::detail::lexical_cast(arguments[at + 1], number))
      throw UsageError(fmt::format("'{}' needs a value before '{}'", word, arguments[at + 1]));
    values.push_back(arguments[++at]);
    int count = 0;
    if (option.values() < 0 && values.size() == 2 && CLI::detail::lexical_cast(values[1], count) && count > 0)
      wanted += count;
  }
  if (static_cast<int>(values.size()) != wanted)
    throw UsageError(fmt::format("'{}' needs {} value{}", word, wanted, wanted == 1 ? "" : "s"));
  return values;
}

/// Takes out what is Gmsh's and gives the rest CLI11's spelling.
std::vector<std::string> translate(const std::vector<std::string>& arguments, Request& request) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    // --name=value is the spelling of other programs; let it be ours as well.
    const std::size_t equals = arguments[i].substr(0, 2) == "--" ? arguments[i].find('=') : std::string::npos;
    const auto option = find_option(arguments[i].substr(0, equals));
    if (!option) {
      words.push_back(arguments[i]);
      continue;
    }
    std::optional<std::string> after_equals;
    if (equals != std::string::npos) after_equals = arguments[i].substr(equals + 1);
    const std::vector<std::string> values = take_values(arguments, *option, after_equals, i);
    if (option->gmsh) {
      note_gmsh_option(*option->gmsh, values, request);
      continue;
    }
    const Row& row = *option->ours;
    // CLI11 would take the next word in its place.
    if (row.values == 1 && values[0].empty())
      throw UsageError(fmt::format("{} needs a value", row.spelling.substr(0, row.spelling.find(' '))));
    words.push_back(values.empty() ? fmt::format("--{}", row.name) : fmt::format("--{}={}", row.name, values[0]));
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

/// Lines of at most 98 characters, each after two blanks.
std::string wrapped(const std::string& words) {
  std::istringstream in(words);
  std::string text, line;
  for (std::string word; in >> word;) {
    if (line.size() + word.size() > 95) text += "  " + std::exchange(line, "") + '\n';
    line += (line.empty() ? "" : " ") + word;
  }
  return text + "  " + line + '\n';
}

/// In the place of CLI11's check, which tells the whole range of a double.
CLI::Validator whole_number(const std::string& option) {
  const auto check = [option](const std::string& text) {
    int number = 0;
    if (!CLI::detail::lexical_cast(text, number) || number < 0)
      throw UsageError(fmt::format("{} takes a whole number, 0 or more", option));
    return std::string();
  };
  return CLI::Validator(check, "");
}

/// \throws UsageError for what asks for a file beside --check
void refuse_files_of_check(const Request& request) {
  const std::array all = {std::pair("-o", !request.output.empty()),     std::pair("--for", !request.consumer.empty()),
                          std::pair("--stats", !request.stats.empty()), std::pair("--report", !request.report.empty()),
                          std::pair("--film", !request.film.empty()),   std::pair("--svg", !request.svg.empty()),
                          std::pair("--pdf", !request.pdf.empty()),     std::pair("--tikz", !request.tikz.empty()),
                          std::pair("--views", request.views),      std::pair("--depfile", !request.depfile.empty())};
  for (const auto& [option, given] : all)
    if (given) throw UsageError(fmt::format("--check writes nothing; leave out {}", option));
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
  bool ignored_flag = false, binary = false, volumes = false;
  std::vector<std::string> inputs;
  app.add_option("IN", inputs);
  app.add_option("--o", request.output);
  app.add_option("--format,--f", request.format);
  app.add_flag("--bin", binary);
  app.add_flag("--2", ignored_flag);
  app.add_flag("--3", volumes);
  app.add_flag("--save", request.no_meshing);
  app.add_option("--part", request.partitions)->check(whole_number("-part"));
  app.add_flag("--drop-volumes", request.drop_volumes);
  app.add_flag("--orient", request.orient);
  app.add_option("--for", request.consumer);
  auto* elements = app.add_option("--elements", request.elements);
  app.add_flag("--check", request.check);
  auto* min_sj = app.add_option("--min-sj", request.thresholds.min_scaled_jacobian)->check(CLI::Range(-1.0, 1.0));
  auto* irregular = app.add_option("--max-irregular", request.thresholds.max_irregular)->check(CLI::Range(0.0, 1.0));
  auto* no_triangles = app.add_flag("--no-triangles", request.thresholds.no_triangles);
  auto* against = app.add_option("--against", request.against);
  auto* distance = app.add_option("--max-distance", request.thresholds.max_distance)->check(CLI::NonNegativeNumber);
  auto* size_ratio = app.add_option("--max-size-ratio", request.thresholds.max_size_ratio)->check(CLI::Range(1.0, 1e9));
  app.add_option("--layers", request.layers)->check(CLI::IsMember({"on", "off"}));
  app.add_option("--nt", request.threads)->check(whole_number("-nt"));
  app.add_option("--v", request.verbosity)->check(whole_number("-v"));
  std::vector<std::string> surfaces;
  app.add_option("--surfaces", surfaces)->delimiter(',')->allow_extra_args(false);
  app.add_flag("--all-quad", request.all_quad);
  app.add_option("--keep-curves", request.keep_curves)->delimiter(',')->allow_extra_args(false);
  app.add_flag("--cleanup-only", request.cleanup_only);
  app.add_option("--stats", request.stats);
  app.add_option("--report", request.report);
  app.add_option("--film", request.film);
  app.add_option("--depfile", request.depfile);
  app.add_option("--svg", request.svg);
  app.add_option("--pdf", request.pdf);
  app.add_option("--tikz", request.tikz);
  auto* stage = app.add_option("--stage", request.stage);
  auto* colour = app.add_option("--colour", request.colour);
  app.add_flag("--views", request.views);
  app.add_flag("--view", request.view);
  app.add_option("--smoothing", request.smoothing);
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
  if (inputs.empty()) throw UsageError("which file? (qmorph IN [-o OUT])");
  if (std::count(inputs.begin(), inputs.end(), "-") && inputs.size() > 1)
    throw UsageError(
        "-: the standard input is read alone; gmsh's \"parse and exit\" is not here, since it writes nothing");
  request.input = inputs.front();
  request.merged.assign(inputs.begin() + 1, inputs.end());
  if (volumes) request.dimension = 3;
  if (*elements && request.consumer != "calculix" && request.consumer != "abaqus")
    throw UsageError("--elements goes with --for calculix or abaqus");
  if (!request.check && (*min_sj || *irregular || *no_triangles || *against || *distance || *size_ratio))
    throw UsageError(
        "--min-sj, --max-irregular, --no-triangles, --against, --max-distance and --max-size-ratio go with --check");
  if ((*distance || *size_ratio) && !*against)
    throw UsageError("--max-distance and --max-size-ratio compare with other triangles; name their mesh: --against FILE");
  if (request.check) refuse_files_of_check(request);
  if (request.all_quad && request.cleanup_only)
    throw UsageError("--all-quad is for the conversion of triangles; --cleanup-only takes curves as they are");
  if (!request.film.empty() && request.cleanup_only)
    throw UsageError("--film shows the front, and --cleanup-only has none");
  if (!request.keep_curves.empty() && !request.all_quad)
    throw UsageError("--keep-curves means nothing without --all-quad");
  if ((*stage || *colour) && !request.wants_picture())
    throw UsageError("--stage and --colour are for pictures: --svg, --pdf or --tikz");
  if (!request.depfile.empty() && (request.output == "-" || (request.output.empty() && request.input == "-")))
    throw UsageError("--depfile: a rule for make needs a target; give -o a name");
  if (binary) request.binary = true;
  for (const std::string& tag : surfaces) request.surfaces.push_back(surface_tag(tag));
  return request;
}

std::string help_text() {
  std::string text(kHelpHead);
  for (const Row& row : kRows)
    if (!row.help.empty()) text += fmt::format("  {:<20} {}\n", row.spelling, row.help);
  text += "\nOf gmsh, with the same meaning; other options of gmsh are refused by name:\n";
  return text + wrapped(passed_gmsh_options()) + std::string(kHelpTail);
}

}  // namespace qmorph::cli
