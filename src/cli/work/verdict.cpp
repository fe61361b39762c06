// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/work/verdict.hpp"

#include <fmt/format.h>

#include "quality/directed_size.hpp"

namespace qmorph::cli {

namespace {

/// "0.21 edges off at (1, 2, 0)" of whatever is farthest off, if that is too far.
std::string too_far(const Fidelity& fidelity, double most) {
  const Spread* worst = &fidelity.node;
  for (const Spread* spread : {&fidelity.side, &fidelity.centre, &fidelity.back})
    if (spread->max > worst->max) worst = spread;
  if (!(worst->max > most)) return "";
  const Eigen::Vector3d& p = worst->where;
  return fmt::format("{:.3g} edges off at ({:g}, {:g}, {:g}), and at most {:g} is asked for", worst->max, p.x(), p.y(),
                     p.z(), most);
}

}  // namespace

std::vector<std::string> find_reasons(const ModelReport& model, const Thresholds& thresholds) {
  std::vector<std::string> reasons;
  for (const SurfaceReport& surface : model.surfaces) {
    const Quality& q = surface.quality;
    const auto say = [&](const std::string& what) {
      reasons.push_back(fmt::format("surface {}: {}", surface.tag, what));
    };
    if (!surface.reason.empty()) say(surface.reason);
    if (q.inverted) say(fmt::format("{} inverted or not convex", q.inverted));
    if (q.quads && !q.inverted && q.scaled_jacobian_min <= thresholds.min_scaled_jacobian)
      say(fmt::format("scaled Jacobian {:.3f}, and more than {:g} is asked for", q.scaled_jacobian_min,
                      thresholds.min_scaled_jacobian));
    if (thresholds.max_size_ratio && surface.conversion.sizes.empty())
      say("the mesh of --against has no triangles where its quads are");
    if (const DirectedSize size = median(surface.conversion.sizes);
        thresholds.max_size_ratio && largest_ratio(size) > *thresholds.max_size_ratio)
      say(fmt::format(
          "its quads are {:.2f} times as long as the triangles were in the direction in which these are longest, and "
          "{:.2f} times in the other (medians); between 1/{:g} and {:g} is asked for",
          size.along, size.across, *thresholds.max_size_ratio, *thresholds.max_size_ratio));
    if (thresholds.no_triangles && surface.triangles_in)
      say(fmt::format("{} triangle{}, and none is allowed", surface.triangles_in,
                      surface.triangles_in == 1 ? "" : "s"));
    if (const std::string off = too_far(surface.fidelity, thresholds.max_distance); !off.empty()) say(off);
  }
  if (model.total.irregular_share() > thresholds.max_irregular)
    reasons.push_back(fmt::format("irregular share of interior nodes {:.3f}, and at most {:g} is asked for",
                                  model.total.irregular_share(), thresholds.max_irregular));
  return reasons;
}

}  // namespace qmorph::cli
