// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <vector>

namespace qmorph {

/// Whether one of these marks is set.
inline bool is_any(const std::vector<char>& marks) {
  return std::any_of(marks.begin(), marks.end(), [](char mark) { return mark != 0; });
}

}  // namespace qmorph
