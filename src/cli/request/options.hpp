// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// All words with a dash that the command knows.

#include <optional>
#include <span>
#include <string_view>

#include "cli/request/gmsh_options.hpp"
#include "cli/request/request.hpp"
#include "cli/request/value.hpp"

namespace qmorph::cli {

/// How often an option may stand on the command line, and whether a word follows it.
enum class Use {
  flag,      ///< no word follows; twice is as good as once
  once,      ///< one word follows
  repeated,  ///< one word follows each time
};

/// One option of ours: its name, what --help says of it, and what it does. All that there is to say of an option is
/// here, but for which options go together (`rules.cpp`).
struct OurOption {
  std::string_view name;      ///< without dashes; one or two may stand before it
  std::string_view spelling;  ///< as --help shows it: "-o FILE"
  Use use;
  std::string_view help;
  void (*apply)(Request& request, const Value& value);  ///< a flag's value is empty. \throws UsageError

  /// "-o", for messages.
  std::string_view word() const { return spelling.substr(0, spelling.find(' ')); }
};

/// Ours, in the order of --help.
std::span<const OurOption> our_options();

/// A word of the command line: one of ours, or one of Gmsh's.
struct Option {
  const OurOption* ours = nullptr;
  const GmshOptionRow* gmsh = nullptr;
  /// Words that follow; -1 as for GmshOptionRow.
  int values() const { return gmsh ? gmsh->values : ours->use == Use::flag ? 0 : 1; }
};

/// Nothing if it is neither.
std::optional<Option> look_up(std::string_view word);

/// Nothing for what is no option, but a file. \throws UsageError for an option that does not exist
std::optional<Option> find_option(std::string_view word);

}  // namespace qmorph::cli
