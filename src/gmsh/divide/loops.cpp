// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/divide/loops.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace qmorph::adapter {

std::vector<Chain> loops_of(const CurveModel& model, const std::vector<Index>& boundary) {
  std::map<int, std::vector<Index>> at_point;  // positions in `boundary`
  for (Index i = 0; i < boundary.size(); ++i)
    for (int end : model.curves[boundary[i]].ends) at_point[end].push_back(i);
  for (const auto& [point, curves] : at_point)
    if (curves.size() != 2) return {};
  std::vector<Chain> loops;
  std::vector<bool> done(boundary.size(), false);
  for (Index first = 0; first < boundary.size(); ++first) {
    if (done[first]) continue;
    Chain loop;
    Index at = first;
    int from = model.curves[boundary[first]].ends[0];
    while (!done[at]) {
      done[at] = true;
      const DividedCurve& curve = model.curves[boundary[at]];
      const bool turned = curve.ends[0] != from;
      loop.push_back({boundary[at], turned});
      from = curve.ends[turned ? 0 : 1];
      const std::vector<Index>& next = at_point[from];
      at = next[0] == at ? next[1] : next[0];
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<std::size_t> corners_of(const CurveModel& model, const Chain& loop, double degrees) {
  const double straight = std::cos(degrees * std::numbers::pi / 180);
  // Where a curve begins and goes, or ends and comes from, as the loop runs.
  const auto direction = [&](const DirectedCurve& c, bool at_end) -> Eigen::Vector3d {
    const std::vector<Eigen::Vector3d>& p = model.curves[c.curve].points;
    const bool at_back = at_end != c.turned;
    const Eigen::Vector3d along = at_back ? p.back() - p[p.size() - 2] : p[1] - p[0];
    return (c.turned ? -1 : 1) * along.normalized();
  };
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const DirectedCurve& before = loop[(i + loop.size() - 1) % loop.size()];
    if (direction(before, true).dot(direction(loop[i], false)) < straight) corners.push_back(i);
  }
  return corners;
}

}  // namespace qmorph::adapter
