// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>

namespace benchmark {

/// Converts the hard inputs whose names contain `word` on one thread, each in a process of its own, and prints a line
/// for each.
/// \param triangles about so many each; nothing: as many as usual
/// \param limit CPU seconds for each \return false if one took more than kMostMicroseconds a triangle
bool time_hard_inputs(const std::string& word, std::optional<double> triangles, double limit);

inline constexpr double kMostMicroseconds = 30;

}  // namespace benchmark
