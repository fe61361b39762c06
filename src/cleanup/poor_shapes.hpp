// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What a change around poor quads is worth.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "kernel/mesh.hpp"

namespace qmorph::cleanup {

/// What a face lacks, in quads of sine 0: none from a sine of 0.6 on, the more the poorer it is.
inline double lack_of(double sine) {
  constexpr double kPoor = 0.6;
  const double lack = std::max(0.0, kPoor - sine) / kPoor;
  return lack * lack;
}

/// Of some faces.
struct PoorShapes {
  double poor = 0, sum = 0, worst = 1;  ///< what they lack; sines
  std::size_t count = 0;

  PoorShapes(const kernel::Mesh& mesh, const std::vector<Index>& faces) : count(faces.size()) {
    for (Index f : faces) {
      const double sine = mesh.smallest_sine(f);
      poor += lack_of(sine);
      sum += sine;
      worst = std::min(worst, sine);
    }
  }

  /// Whether poor quads have become better by `least_gain`, of which what all sines together lose takes something, and
  /// the worst no worse. Fewer elements are no loss, nor more a gain.
  bool is_worth(const PoorShapes& before, double least_gain) const {
    constexpr double kPriceOfLoss = 0.15;
    const double loss = std::max(0.0, before.sum / double(before.count) * double(count) - sum);
    return before.poor - poor - kPriceOfLoss * loss >= least_gain && worst >= before.worst;
  }
};

}  // namespace qmorph::cleanup
