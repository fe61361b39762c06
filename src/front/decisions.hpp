// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <limits>

#include "qmorph/options.hpp"

namespace qmorph::front {

/// Where a constant may lie without a comparison turning out differently.
class Range {
 public:
  /// Notes that `value` was compared with the constant, and whether it was less.
  void note(double value, bool was_less) { was_less ? from_ = std::max(from_, value) : to_ = std::min(to_, value); }
  bool contains(double constant) const {
    constexpr double kRounding = 1e-9;
    return constant > from_ + kRounding && constant < to_ - kRounding;
  }

 private:
  double from_ = -std::numeric_limits<double>::infinity(), to_ = std::numeric_limits<double>::infinity();
};

/// What a front has decided by each constant: with others in the same ranges it would have done the same from its first
/// step to its last.
struct Decisions {
  Range corner;  ///< of signed_square(cosine of the angle)
  Range seam, seam_many, transition, side_edge;

  bool would_be_same(const FrontOptions& options) const;
};

/// x |x|: in the order of x.
inline double signed_square(double x) { return x < 0 ? -x * x : x * x; }

}  // namespace qmorph::front
