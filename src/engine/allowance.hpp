// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <cstddef>

namespace qmorph {

/// The work (`kernel::Mesh::work()`) that a surface of so many triangles may cost in all, whatever comes with it in the
/// model. An ordinary one takes 60 to 400 a triangle; 1000 take about 17 microseconds. Small surfaces may cost more per
/// triangle, because tries with other constants gain much there: in a small region a single step of the front decides
/// the result.
inline double allowance(std::size_t triangles) {
  constexpr double kEach = 1800, kFew = 12e6, kLessEach = 4800, kMostEach = 60000;
  const double n = double(triangles);
  return std::min(kMostEach * n, std::max(kEach * n, kFew - kLessEach * n));
}

/// What one of `count` regions gets of that: half is shared by triangles, half evenly, because a small region that
/// turns out badly is worth many tries.
inline double part_of(double allowed, std::size_t triangles, std::size_t triangles_of_all, std::size_t count) {
  return 0.5 * allowed * (double(triangles) / double(triangles_of_all) + 1 / double(count));
}

}  // namespace qmorph
