#include "engine/overlap.hpp"

#include <algorithm>

#include "geometry/predicates.hpp"
#include "qmorph/error.hpp"

namespace qmorph {
namespace {

struct Segment {
  Vec2 a, b;
  double left() const { return std::min(a.x(), b.x()); }
  double right() const { return std::max(a.x(), b.x()); }
  double low() const { return std::min(a.y(), b.y()); }
  double high() const { return std::max(a.y(), b.y()); }
};

bool cross_properly(const Segment& s, const Segment& t) {
  return orientation(s.a, s.b, t.a) * orientation(s.a, s.b, t.b) < 0 &&
         orientation(t.a, t.b, s.a) * orientation(t.a, t.b, s.b) < 0;
}

/// The wedge of a convex corner from direction a counter-clockwise to b holds the direction of the x axis.
bool holds_x_axis(const Vec2& a, const Vec2& b) { return (a.y() < 0 || (a.y() == 0 && a.x() > 0)) && b.y() > 0; }

void require_single_cover(const Region& region, const Plane& plane) {
  std::vector<unsigned char> covers(region.points.size(), 0);
  for (const auto& t : region.triangles)
    for (int i = 0; i < 3; ++i) {
      const Vec2& p = region.points[t[i]];
      if (!holds_x_axis(region.points[t[(i + 1) % 3]] - p, region.points[t[(i + 2) % 3]] - p)) continue;
      if (++covers[t[i]] > 1)
        throw SurfaceError("the triangles around the node at " + describe(plane.to_space(p)) +
                               " overlap; mesh the surface anew or repair it",
                           {.kind = ErrorKind::overlap, .place = plane.to_space(p)});
    }
}

std::vector<Segment> outline_of(const std::vector<Region>& regions) {
  std::vector<Segment> outline;
  for (const Region& region : regions)
    for (Index c = 0; c < region.open.size(); ++c) {
      if (!region.open[c]) continue;
      const auto& t = region.triangles[c / 3];
      outline.push_back({region.points[t[c % 3]], region.points[t[(c + 1) % 3]]});
    }
  std::stable_sort(outline.begin(), outline.end(),
                   [](const Segment& s, const Segment& t) { return s.left() < t.left(); });
  return outline;
}

void require_no_crossing(const std::vector<Segment>& outline, const Plane& plane) {
  std::vector<Segment> active;
  for (const Segment& s : outline) {
    std::erase_if(active, [&](const Segment& t) { return t.right() < s.left(); });
    for (const Segment& t : active)
      if (s.low() <= t.high() && t.low() <= s.high() && cross_properly(s, t))
        throw SurfaceError("boundary or constraint edges cross near " + describe(plane.to_space(s.a)) +
                               ", so triangles overlap; mesh the surface anew or repair it",
                           {.kind = ErrorKind::overlap, .place = plane.to_space(s.a)});
    active.push_back(s);
  }
}

}  // namespace

void require_sound(const Patch& patch) {
  const auto require_node = [&](Index v) {
    if (v >= patch.points.size())
      throw SurfaceError("an element uses node " + std::to_string(v) + " of " + std::to_string(patch.points.size()),
                         {.kind = ErrorKind::bad_element, .subject = node_row(v)});
  };
  const auto require_element = [&](const auto& nodes) {
    for (Index v : nodes) require_node(v);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes[i] == nodes[(i + 1) % nodes.size()])
        throw SurfaceError(
            "an element uses the node at " + describe(patch.points[nodes[i]]) + " twice; remove or collapse it",
            {.kind = ErrorKind::bad_element, .place = patch.points[nodes[i]], .subject = node_row(nodes[i])});
  };
  for (const auto& t : patch.triangles) require_element(t);
  for (const auto& q : patch.quads) require_element(q);
  for (const auto& c : patch.constraints) require_element(c);
  for (Index v : patch.fixed) require_node(v);
}

void require_no_overlap(const std::vector<Region>& regions, const Plane& plane) {
  for (const Region& region : regions) require_single_cover(region, plane);
  require_no_crossing(outline_of(regions), plane);
}

}  // namespace qmorph
