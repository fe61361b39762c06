// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>

#include "qmorph/patch.hpp"

namespace qmorph::test {

/// Adds a quad's halves, cut along the diagonal from its first corner or the other one.
inline void add_halves(Patch& patch, const std::array<Index, 4>& quad, bool from_first) {
  const auto& [a, b, c, d] = quad;
  patch.triangles.push_back(from_first ? std::array{a, b, c} : std::array{a, b, d});
  patch.triangles.push_back(from_first ? std::array{a, c, d} : std::array{b, c, d});
}

}  // namespace qmorph::test
