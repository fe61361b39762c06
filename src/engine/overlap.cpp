// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>
#include <tuple>
#include <vector>

#include "geometry/predicates.hpp"
#include "qmorph/error.hpp"

namespace qmorph {
namespace {

/// From the end that lies more to the left; of a vertical one, from the lower end.
struct Segment {
  Vec2 a, b;
};

bool is_before(const Vec2& p, const Vec2& q) { return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y(); }

bool cross_properly(const Segment& s, const Segment& t) {
  return orientation(s.a, s.b, t.a) * orientation(s.a, s.b, t.b) < 0 &&
         orientation(t.a, t.b, s.a) * orientation(t.a, t.b, s.b) < 0;
}

/// The wedge of a convex corner from direction a counter-clockwise to b holds the direction of the x axis.
bool holds_x_axis(const Vec2& a, const Vec2& b) { return (a.y() < 0 || (a.y() == 0 && a.x() > 0)) && b.y() > 0; }

SurfaceError overlap_around(const Eigen::Vector3d& place, Index row) {
  return SurfaceError(
      "the triangles around the node at " + describe(place) + " overlap; mesh the surface anew or repair it",
      {.kind = ErrorKind::overlap, .place = place, .subject = node_row(row)});
}

void require_single_cover(const Region& region, const Plane& plane) {
  std::vector<unsigned char> covers(region.points.size(), 0);
  for (const auto& t : region.triangles)
    for (int i = 0; i < 3; ++i) {
      const Vec2& p = region.points[t[i]];
      if (!holds_x_axis(region.points[t[(i + 1) % 3]] - p, region.points[t[(i + 2) % 3]] - p)) continue;
      if (++covers[t[i]] > 1) throw overlap_around(plane.to_space(p), region.node[t[i]]);
    }
}

/// The triangles around a node of the outline, from the first side counter-clockwise to the last, seen from the node.
struct Fan {
  Vec2 place;
  double start = 0, width = 0;  ///< angles
  Index row = kNone;            ///< of Patch::points

  bool is_before(const Fan& other) const {
    return std::tuple(place.x(), place.y(), start, width, row) <
           std::tuple(other.place.x(), other.place.y(), other.start, other.width, other.row);
  }
};

double angle_of(const Vec2& v) { return std::atan2(v.y(), v.x()); }

std::vector<Fan> fans_of(const std::vector<Region>& regions) {
  std::vector<Fan> fans;
  for (const Region& region : regions) {
    std::vector<Index> fan_of(region.points.size(), kNone);
    const auto corner = [&](Index c) { return region.triangles[c / 3][c % 3]; };
    const auto next = [](Index c) { return c % 3 == 2 ? c - 2 : c + 1; };
    const auto way = [&](Index c, Index to) { return Vec2(region.points[corner(to)] - region.points[corner(c)]); };
    for (Index c = 0; c < region.open.size(); ++c) {
      if (!region.open[c]) continue;
      fan_of[corner(c)] = Index(fans.size());
      fans.push_back({region.points[corner(c)], angle_of(way(c, next(c))), 0, region.node[corner(c)]});
    }
    for (Index c = 0; c < region.open.size(); ++c) {
      if (fan_of[corner(c)] == kNone) continue;
      const Vec2 first = way(c, next(c)), last = way(c, next(next(c)));
      fans[fan_of[corner(c)]].width += std::atan2(cross(first, last), first.dot(last));
    }
  }
  std::sort(fans.begin(), fans.end(), [](const Fan& a, const Fan& b) { return a.is_before(b); });
  return fans;
}

/// Fans at one place lie side by side, whether they belong to one region and one node or not.
void require_fans_apart(const std::vector<Region>& regions, const Plane& plane) {
  constexpr double kTurn = 2 * std::numbers::pi, kTouching = 1e-6;
  const std::vector<Fan> fans = fans_of(regions);
  for (std::size_t first = 0, last = 0; first < fans.size(); first = last) {
    while (last < fans.size() && fans[last].place == fans[first].place) ++last;
    for (std::size_t i = first; i < last; ++i) {
      const double following = i + 1 < last ? fans[i + 1].start : fans[first].start + kTurn;
      if (fans[i].start + fans[i].width > following + kTouching)
        throw overlap_around(plane.to_space(fans[i].place), fans[i].row);
    }
  }
}

std::vector<Segment> outline_of(const std::vector<Region>& regions) {
  std::vector<Segment> outline;
  for (const Region& region : regions)
    for (Index c = 0; c < region.open.size(); ++c) {
      if (!region.open[c]) continue;
      const auto& t = region.triangles[c / 3];
      const Vec2 &p = region.points[t[c % 3]], &q = region.points[t[(c + 1) % 3]];
      if (p == q) continue;
      outline.push_back(is_before(p, q) ? Segment{p, q} : Segment{q, p});
    }
  return outline;
}

/// A line sweeps from left to right over segments and keeps those that it meets in their order along it. Before two
/// cross, they are neighbours there. [ShamosHoey76] Segments may share ends and coincide.
class Sweep {
 public:
  explicit Sweep(const std::vector<Segment>& segments)
      : segments_(segments), line_(IsBelow{&segments}), place_(segments.size(), line_.end()) {}

  /// One of two segments that cross, or kNone.
  Index run() {
    struct Event {
      Vec2 p;
      Index segment;
      bool begins;
    };
    std::vector<Event> events;
    events.reserve(2 * segments_.size());
    for (Index i = 0; i < segments_.size(); ++i)
      events.push_back({segments_[i].a, i, true}), events.push_back({segments_[i].b, i, false});
    std::sort(events.begin(), events.end(), [](const Event& e, const Event& f) {
      if (e.p != f.p) return is_before(e.p, f.p);
      return e.begins != f.begins ? f.begins : e.segment < f.segment;  // what ends at a node goes first
    });
    for (const Event& event : events) {
      const Index found = event.begins ? begin(event.segment) : end(event.segment);
      if (found != kNone) return found;
    }
    return kNone;
  }

 private:
  /// Of a segment that begins and one that the line meets; of equal ones the numbers decide.
  struct IsBelow {
    const std::vector<Segment>* segments;
    bool operator()(Index i, Index j) const {
      const Segment &s = (*segments)[i], &t = (*segments)[j];
      if (is_before(s.a, t.a)) return side(s, t) > 0 || (side(s, t) == 0 && i < j);
      return side(t, s) < 0 || (side(t, s) == 0 && i < j);
    }
    /// 1 if the other begins above, or on it and leads upwards.
    static int side(const Segment& s, const Segment& other) {
      const int begin = orientation(s.a, s.b, other.a);
      return begin != 0 ? begin : orientation(s.a, s.b, other.b);
    }
  };
  using Line = std::set<Index, IsBelow>;

  Index begin(Index i) {
    const auto at = place_[i] = line_.insert(i).first;
    if (at != line_.begin() && cross(*std::prev(at), i)) return i;
    return std::next(at) != line_.end() && cross(i, *std::next(at)) ? i : kNone;
  }

  Index end(Index i) {
    const auto after = line_.erase(place_[i]);
    return after != line_.end() && after != line_.begin() && cross(*std::prev(after), *after) ? *after : kNone;
  }

  bool cross(Index i, Index j) const { return cross_properly(segments_[i], segments_[j]); }

  const std::vector<Segment>& segments_;
  Line line_;
  std::vector<Line::iterator> place_;
};

void require_no_crossing(const std::vector<Segment>& outline, const Plane& plane) {
  if (const Index i = Sweep(outline).run(); i != kNone)
    throw SurfaceError("boundary or constraint edges cross near " + describe(plane.to_space(outline[i].a)) +
                           ", so triangles overlap; mesh the surface anew or repair it",
                       {.kind = ErrorKind::overlap, .place = plane.to_space(outline[i].a)});
}

void require_finite(const Patch& patch) {
  constexpr double kLargest = 1e75;  // fourth powers of lengths overflow beyond it
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    const Eigen::Vector3d& p = patch.points[i];
    if (p.allFinite() && p.cwiseAbs().maxCoeff() <= kLargest) continue;
    throw SurfaceError("node " + std::to_string(i) + " has the coordinates " + describe(p) +
                           (p.allFinite() ? ", too large to compute with; repair the input" : "; repair the input"),
                       {.kind = ErrorKind::not_finite, .subject = node_row(i)});
  }
}

}  // namespace

void require_sound(const Patch& patch) {
  require_finite(patch);
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

bool is_turned_over(const std::array<Vec2, 3>& corners) {
  const auto& [a, b, c] = corners;
  return orientation(a, b, c) < 0 &&
         std::min({corner_sine(a, b, c), corner_sine(b, c, a), corner_sine(c, a, b)}) < -kDegenerateSine;
}

SurfaceError turned_over(const std::array<Vec2, 3>& corners, const Plane& plane, std::optional<ErrorSubject> subject) {
  std::string places;
  for (const Vec2& corner : corners) places += (places.empty() ? "" : ", ") + describe(plane.to_space(corner));
  return SurfaceError(
      "the triangle " + places + " is turned over, so triangles overlap; mesh the surface anew or repair it",
      {.kind = ErrorKind::overlap, .place = plane.to_space(corners[0]), .subject = subject});
}

void require_fronts(const std::vector<Region>& regions, const Plane& plane) {
  for (const Region& region : regions)
    for (const auto& [a, b, c] : region.triangles)
      if (const std::array corners{region.points[a], region.points[b], region.points[c]}; is_turned_over(corners))
        throw turned_over(corners, plane, node_row(region.node[a]));
}

void require_no_overlap(const std::vector<Region>& regions, const Plane& plane) {
  for (const Region& region : regions) require_single_cover(region, plane);
  require_fans_apart(regions, plane);
  require_no_crossing(outline_of(regions), plane);
}

}  // namespace qmorph
