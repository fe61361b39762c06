// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/canonical/rounded.hpp"

#include <algorithm>
#include <cmath>

namespace qmorph::canonical {
namespace {

constexpr double kSteps = 0x1p-36;       // of the box's size
constexpr double kLeastHeight = 0x1p20;  // of a triangle, in steps: no angle changes by more than a millionth
constexpr double kUnlike = 1.37;         // sizes that are powers of two are not where the step changes

/// None of the corners is nearer than that to the line through the others.
bool is_higher(const Vec2& a, const Vec2& b, const Vec2& c, double height) {
  const Vec2 ab = b - a, bc = c - b, ca = a - c;
  const double longest = std::max({ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm()}), area = cross(ab, bc);
  return area > 0 && area * area > height * height * longest;
}

}  // namespace

std::optional<Rounding> round_points(Region& region, const Plane& plane) {
  constexpr double kWhole = 0x1p52;  // from here on the spacing of numbers is 1
  Vec2 low = region.points.at(0), high = low;
  for (const Vec2& p : region.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double size = (high - low).maxCoeff(), step = kSteps * std::exp2(std::ilogb(kUnlike * size));
  const auto is_too_small = [&](const std::array<Index, 3>& t) {
    return !is_higher(region.points[t[0]], region.points[t[1]], region.points[t[2]], kLeastHeight * step);
  };
  if (!std::isnormal(step) || std::any_of(region.triangles.begin(), region.triangles.end(), is_too_small)) return {};
  Rounding result{region.points, plane, low};
  result.plane.origin = plane.on_plane(low);
  const Vec2 whole = Vec2::Constant(kWhole);
  for (Vec2& p : region.points) p = (((p - low) / step + whole) - whole) * step;
  return result;
}

void put_back(kernel::Mesh& mesh, const Rounding& rounding, const Region& region) {
  for (Index v = 0; v < mesh.vertex_slots(); ++v) {
    if (!mesh.is_live_vertex(v)) continue;
    const bool is_still = v < region.points.size() && mesh.point(v) == region.points[v];
    mesh.set_point(v, is_still ? rounding.exact[v] : Vec2(mesh.point(v) + rounding.corner));
  }
}

}  // namespace qmorph::canonical
