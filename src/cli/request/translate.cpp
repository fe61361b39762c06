// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/request/translate.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "cli/request/options.hpp"
#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

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

}  // namespace

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

std::string with_our_spelling(std::string message) {
  for (const Row& row : our_options()) {
    if (row.spelling.substr(0, 2) == "--") continue;
    const std::string theirs = fmt::format("--{}", row.name);
    for (std::size_t at = 0; (at = message.find(theirs, at)) != std::string::npos; ++at) {
      const std::size_t end = at + theirs.size();
      if (end == message.size() || !std::isalnum(static_cast<unsigned char>(message[end]))) message.erase(at, 1);
    }
  }
  return message;
}

}  // namespace qmorph::cli
