// SPDX-License-Identifier: GPL-2.0-or-later
#include "smoothing/untangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/predicates.hpp"

namespace qmorph::smoothing {
namespace {

/// A corner's area around a node as a function of the node's position x: slope . x + offset.
struct CornerArea {
  Vec2 slope;
  double offset;
  double at(const Vec2& x) const { return slope.dot(x) + offset; }
};

std::vector<CornerArea> corner_areas(const kernel::Mesh& mesh, Index v) {
  std::vector<CornerArea> areas;
  const Vec2 centre = mesh.point(v);  // positions are relative to it, against cancellation
  // (b - a) x (x - a) as a function of x
  const auto add = [&](const Vec2& a, const Vec2& b) {
    const Vec2 d = b - a;
    areas.push_back({{-d.y(), d.x()}, -cross(d, a)});
  };
  for (Index h : mesh.around(v)) {
    if (mesh.face(h) != kNone) {
      const Index to_v = mesh.prev(h);
      const Vec2 q = mesh.point(mesh.target(h)) - centre, r = mesh.point(mesh.origin(to_v)) - centre;
      const Vec2 after_q = mesh.point(mesh.target(mesh.next(h))) - centre;
      const Vec2 before_r = mesh.point(mesh.origin(mesh.prev(to_v))) - centre;
      add(q, r);  // corner at v: x, q, r counter-clockwise
      if (mesh.degree(mesh.face(h)) == 4) {
        add(q, after_q);   // corner at q: q, after_q, x
        add(before_r, r);  // corner at r: r, x, before_r
      }
    }
  }
  return areas;
}

/// The smallest area at x, or any that is not above `floor`.
double smallest(const std::vector<CornerArea>& areas, const Vec2& x, double floor) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& a : areas) {
    least = std::min(least, a.at(x));
    if (!(least > floor)) break;
  }
  return least;
}

/// Where the smallest of the areas is largest, found by going uphill: on one plane, then along the line where two are
/// equal, from corner to corner of the roof that the smallest of all planes is.
class Roof {
 public:
  explicit Roof(const std::vector<CornerArea>& areas) : areas_(areas) {}

  /// The areas that are smallest at the top, all but for rounding; nothing if there was no way up.
  std::vector<std::size_t> climb() {
    std::size_t i = 0;
    for (std::size_t n = 1; n < areas_.size(); ++n)
      if (areas_[n].offset < areas_[i].offset) i = n;
    std::optional<std::size_t> j = walk(areas_[i].slope, i, {});
    if (!j) return {};
    std::optional<std::size_t> k = along(i, *j, {});
    constexpr int kMostCorners = 40;  // more only if it goes round in circles
    for (int corner = 0; k && corner < kMostCorners; ++corner) {
      const std::array<std::size_t, 3> at{i, *j, *k};
      int side = 0;
      while (side < 3 && !leads_up(at[side], at[(side + 1) % 3], at[(side + 2) % 3])) ++side;
      if (side == 3) return lowest(at);
      i = at[side], j = at[(side + 1) % 3];
      k = along(i, *j, at[(side + 2) % 3]);
    }
    return {};
  }

 private:
  /// The way along the line where i and j are equal, uphill.
  Vec2 line(std::size_t i, std::size_t j) const {
    const Vec2 across = areas_[i].slope - areas_[j].slope, way(-across.y(), across.x());
    return areas_[i].slope.dot(way) < 0 ? Vec2(-way) : way;
  }

  /// Whether the line of i and j, uphill, leaves k above.
  bool leads_up(std::size_t i, std::size_t j, std::size_t k) const {
    const Vec2 way = line(i, j);
    return areas_[i].slope.dot(way) > 0 && areas_[k].slope.dot(way) > areas_[i].slope.dot(way);
  }

  std::optional<std::size_t> along(std::size_t i, std::size_t j, std::optional<std::size_t> left) {
    return walk(line(i, j), i, {j, left});
  }

  /// Goes on until an area is as small as i, and returns that.
  std::optional<std::size_t> walk(const Vec2& way, std::size_t i, std::array<std::optional<std::size_t>, 2> others) {
    const double rise = areas_[i].slope.dot(way), height = areas_[i].at(x_);
    double share = std::numeric_limits<double>::infinity();
    std::optional<std::size_t> met;
    for (std::size_t n = 0; n < areas_.size(); ++n) {
      if (n == i || n == others[0] || n == others[1]) continue;
      const double nearer = rise - areas_[n].slope.dot(way);
      if (!(nearer > 0)) continue;
      const double until = std::max(0.0, areas_[n].at(x_) - height) / nearer;
      if (until < share) share = until, met = n;
    }
    if (met) x_ += share * way;
    return met;
  }

  std::vector<std::size_t> lowest(const std::array<std::size_t, 3>& corner) const {
    constexpr double kRounding = 1e-9;
    double most = 0;
    for (const CornerArea& area : areas_) most = std::max(most, std::abs(area.offset));
    const double height = areas_[corner[0]].at(x_);
    std::vector<std::size_t> found;
    for (std::size_t n = 0; n < areas_.size(); ++n)
      if (areas_[n].at(x_) <= height + kRounding * most || std::count(corner.begin(), corner.end(), n) > 0)
        found.push_back(n);
    return found;
  }

  const std::vector<CornerArea>& areas_;
  Vec2 x_ = Vec2::Zero();
};

}  // namespace

bool untangle_node(kernel::Mesh& mesh, Index v) {
  if (!mesh.is_free(v)) return false;
  const std::vector<CornerArea> areas = corner_areas(mesh, v);
  // The optimum of three unknowns (x and the smallest area) is where three areas are equal, or more.
  const std::vector<std::size_t> top = Roof(areas).climb();
  Vec2 best = Vec2::Zero();
  double best_area = smallest(areas, best, -std::numeric_limits<double>::infinity());
  const double before = best_area;
  for (std::size_t i = 0; i < top.size(); ++i)
    for (std::size_t j = i + 1; j < top.size(); ++j)
      for (std::size_t k = j + 1; k < top.size(); ++k) {
        const CornerArea &one = areas[top[i]], &two = areas[top[j]], &three = areas[top[k]];
        const Vec2 a = one.slope - two.slope, b = one.slope - three.slope;
        const double determinant = cross(a, b);
        if (determinant == 0) continue;
        const double p = two.offset - one.offset, q = three.offset - one.offset;
        const Vec2 x((p * b.y() - q * a.y()) / determinant, (a.x() * q - b.x() * p) / determinant);
        const double area = smallest(areas, x, best_area);
        if (area > best_area) best = x, best_area = area;
      }
  if (!(best_area > before)) return false;
  mesh.set_point(v, mesh.point(v) + best);
  return true;
}

namespace {

constexpr double kNoFloor = -std::numeric_limits<double>::infinity();

/// Sine of the corner, or less where its edges differ in length by more than about twenty times: the sine alone
/// would let a node fall onto its neighbour. Any that is not above `floor` if the sine is not; most places that are
/// tried are told by that, without a root.
double guarded_sine(const Vec2& at, const Vec2& to_next, const Vec2& to_previous, double floor) {
  constexpr double kLengthGuard = 10, kSurely = 1 - 1e-12;
  const Vec2 a = to_next - at, b = to_previous - at;
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), area = cross(a, b);
  if (floor >= 0 && (area <= 0 || area * area < kSurely * floor * floor * aa * bb)) return floor;
  if (!(aa * bb > 0)) return -1;
  const double sine = area / std::sqrt(aa * bb);
  return std::min(sine, kLengthGuard * 2 * area / (aa + bb));
}

/// The corners of the faces around a node, looked at once, so that trying places costs no walk through the mesh.
class Corners {
 public:
  Corners(const kernel::Mesh& mesh, Index v) {
    for (Index h : mesh.around(v))
      if (mesh.face(h) != kNone) add_face(mesh, h);
  }

  /// Elements looked at so far.
  std::size_t work() const { return work_; }

  /// The smallest guarded sine with the node at p, or any that is not above `floor`.
  double smallest(const Vec2& p, double floor) {
    double least = still_;
    for (const Element& e : elements_) {
      ++work_;
      if (!(least > floor)) break;
      least = std::min(least, guarded_sine(p, e.q, e.r, floor));
      if (least > floor) least = std::min(least, guarded_sine(e.q, e.after_q, p, floor));
      if (least > floor) least = std::min(least, guarded_sine(e.r, p, e.before_r, floor));
    }
    return least;
  }

 private:
  /// A face that runs v, q, after_q, ..., before_r, r.
  struct Element {
    Vec2 q, after_q, before_r, r;
  };

  void add_face(const kernel::Mesh& mesh, Index h) {
    const Index to_v = mesh.prev(h), last = mesh.prev(to_v);
    elements_.push_back({mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))),
                         mesh.point(mesh.origin(last)), mesh.point(mesh.origin(to_v))});
    for (Index e = mesh.next(mesh.next(h)); e != to_v; e = mesh.next(e))
      still_ = std::min(still_, guarded_sine(mesh.point(mesh.origin(e)), mesh.point(mesh.target(e)),
                                             mesh.point(mesh.origin(mesh.prev(e))), kNoFloor));
  }

  std::vector<Element> elements_;
  double still_ = 1;  ///< of the corners that do not depend on the node
  std::size_t work_ = 0;
};

double shortest_edge(const kernel::Mesh& mesh, Index v) {
  double shortest = std::numeric_limits<double>::infinity();
  for (Index h : mesh.around(v)) shortest = std::min(shortest, mesh.length(h));
  return shortest;
}

}  // namespace

bool raise_smallest_sine(kernel::Mesh& mesh, Index v, std::size_t& work) {
  if (!mesh.is_free(v)) return false;
  constexpr int kShrinkings = 6, kMostRounds = 40;
  constexpr double kFirstStep = 0.25, kLeastGain = 1e-6, kDiagonal = 0.70710678118654752;
  static constexpr double kCompass[][2] = {{1, 0},  {kDiagonal, kDiagonal},   {0, 1},  {-kDiagonal, kDiagonal},
                                           {-1, 0}, {-kDiagonal, -kDiagonal}, {0, -1}, {kDiagonal, -kDiagonal}};
  Corners corners(mesh, v);
  const Vec2 start = mesh.point(v);
  Vec2 best = start;
  double best_sine = corners.smallest(best, kNoFloor);
  double step = kFirstStep * shortest_edge(mesh, v);
  for (int shrinking = 0, rounds = 0; shrinking < kShrinkings && rounds < kMostRounds; ++rounds) {
    const Vec2 centre = best;
    for (const auto& d : kCompass) {
      const Vec2 p = centre + step * Vec2(d[0], d[1]);
      const double sine = corners.smallest(p, best_sine + kLeastGain);
      if (sine > best_sine + kLeastGain) best = p, best_sine = sine;
    }
    if (best == centre) step /= 2, ++shrinking;
  }
  work += corners.work();
  if (best == start) return false;
  // The guard on lengths may have paid for a rise with a corner's sine.
  const bool was_valid = mesh.is_valid_star(v);
  mesh.set_point(v, best);
  if (!was_valid || mesh.is_valid_star(v)) return true;
  mesh.set_point(v, start);
  return false;
}

bool has_immovable_fault(const kernel::Mesh& mesh, std::span<const Index> free_nodes) {
  const auto moves = [&](Index v) { return std::binary_search(free_nodes.begin(), free_nodes.end(), v); };
  const auto is_bad = [&](Index h) {
    const Index before = mesh.origin(mesh.prev(h)), at = mesh.origin(h), after = mesh.target(h);
    return !moves(before) && !moves(at) && !moves(after) &&
           !is_convex_corner(mesh.point(before), mesh.point(at), mesh.point(after), kStraightSine);
  };
  for (Index v : free_nodes) {
    for (Index h : mesh.around(v))  // the corner that v is no part of: opposite in a quad, none in a triangle
      if (mesh.is_quad(mesh.face(h)) && is_bad(mesh.next(mesh.next(h)))) return true;
  }
  return false;
}

}  // namespace qmorph::smoothing
