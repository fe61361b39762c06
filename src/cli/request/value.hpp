// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The word behind an option, and what it may be.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace qmorph::cli {

/// Nothing where the text is not a number from its first character to its last.
std::optional<double> to_number(std::string_view text);
std::optional<int> to_whole_number(std::string_view text);

struct Value {
  std::string_view option;  ///< as --help spells it, for the messages
  const std::string& text;
};

/// \throws UsageError that names the option, unless low <= value <= high; an infinite `high` is no limit
double number_in(const Value& value, double low, double high);

/// 0 or more. \throws UsageError
int count_in(const Value& value);

/// The tags in "3,7". \param entities what they are tags of: "surfaces", "curves". \throws UsageError
std::vector<int> tags_in(const Value& value, std::string_view entities);

}  // namespace qmorph::cli
