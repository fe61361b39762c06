// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/request/value.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

template <class Number>
std::optional<Number> convert(std::string_view text) {
  // Unlike strtod(), from_chars() reads numbers the same way in every locale, but it does not know a leading plus.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

std::optional<double> to_number(std::string_view text) { return convert<double>(text); }

std::optional<int> to_whole_number(std::string_view text) { return convert<int>(text); }

double number_in(const Value& value, double low, double high) {
  const auto number = to_number(value.text);
  if (number && *number >= low && *number <= high) return *number;
  const std::string range =
      std::isfinite(high) ? fmt::format("from {} to {}", low, high) : fmt::format("{} or more", low);
  throw UsageError(fmt::format("{} takes a number, {}, not '{}'", value.option, range, value.text));
}

int count_in(const Value& value) {
  const auto number = to_whole_number(value.text);
  if (!number || *number < 0) throw UsageError(fmt::format("{} takes a whole number, 0 or more", value.option));
  return *number;
}

std::vector<int> tags_in(const Value& value, std::string_view entities) {
  std::vector<int> tags;
  std::istringstream in(value.text + ',');
  for (std::string word; std::getline(in, word, ',');) {
    const auto tag = to_whole_number(word);
    if (!tag || *tag < 0)
      throw UsageError(fmt::format("{}: '{}' is not a tag; give the numbers of {}, as 3,7 (not of groups, nor names)",
                                   value.option, word, entities));
    tags.push_back(*tag);
  }
  return tags;
}

}  // namespace qmorph::cli
