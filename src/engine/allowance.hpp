// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <cstddef>

namespace qmorph {

/// The work (`kernel::Mesh::work()`) that a conversion of so many triangles may cost in all. An ordinary one takes 50 to 300 a
/// triangle; 1000 take about 17 microseconds. Few triangles may cost more each: the time that they take is nobody's concern.
inline double allowance(double triangles) {
  constexpr double kEach = 1800, kFew = 4.2e6, kLessEach = 2000;
  return std::max(kEach * triangles, kFew - kLessEach * triangles);
}

/// What one of `count` surfaces or regions gets of that: half is shared by triangles, half evenly, for a small region
/// that turns out badly is worth many tries.
inline double part_of(double allowed, double triangles, double triangles_of_all, std::size_t count) {
  return 0.5 * allowed * (triangles / triangles_of_all + 1 / double(count));
}

}  // namespace qmorph
