// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What a cut costs beside its length, wherever something large is cut into parts.

#include <algorithm>

namespace qmorph {

/// The cost of one end of a cut, in lengths of what is cut. A cut that meets the outline at a flat angle leaves a
/// wedge, which is no place for quads, so an end costs more the smaller the sine of that angle is.
inline double cost_of_cut_end(double sine) {
  constexpr double kEnd = 0.02, kFlat = 0.5;
  constexpr double kSquare = 0.9;  // from this sine on an end is no wedge
  return kEnd + kFlat * std::max(0.0, kSquare - sine);
}

}  // namespace qmorph
