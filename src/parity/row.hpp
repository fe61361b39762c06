// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Rows and columns of systems over two elements, where 1 + 1 = 0.

#include <algorithm>
#include <iterator>
#include <vector>

#include "qmorph/index.hpp"

namespace qmorph::parity {

using Row = std::vector<Index>;  ///< where it is 1, in order

/// The sum: what is in one of the two.
inline Row symmetric_difference(const Row& a, const Row& b) {
  Row difference;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(difference));
  return difference;
}

}  // namespace qmorph::parity
