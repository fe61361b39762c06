// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// All words with a dash that the command knows.

#include <optional>
#include <span>
#include <string_view>

#include "cli/request/gmsh_options.hpp"

namespace qmorph::cli {

/// One option of ours. Gmsh writes long names with one dash, CLI11 with two: this table knows both, and how many
/// words follow. Options without values are flags.
struct Row {
  std::string_view name;      ///< without dashes
  std::string_view spelling;  ///< as --help shows it
  int values;
  std::string_view help;
};

/// Ours, in the order of --help.
std::span<const Row> our_options();

/// A word of the command line: one of ours, or one of Gmsh's.
struct Option {
  const Row* ours = nullptr;
  const GmshOptionRow* gmsh = nullptr;
  int values() const { return ours ? ours->values : gmsh->values; }
};

/// Nothing if it is neither.
std::optional<Option> look_up(std::string_view word);

/// Nothing for what is no option, but a file. \throws UsageError for an option that there is not
std::optional<Option> find_option(std::string_view word);

}  // namespace qmorph::cli
