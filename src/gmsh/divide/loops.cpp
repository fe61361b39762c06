// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/divide/loops.hpp"

#include <algorithm>
#include <map>

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

}  // namespace qmorph::adapter
