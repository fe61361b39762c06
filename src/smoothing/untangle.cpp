// SPDX-License-Identifier: GPL-2.0-or-later
#include "smoothing/untangle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
  Index h = mesh.out(v);
  do {
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
    h = mesh.rotate_ccw(h);
  } while (h != mesh.out(v));
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

}  // namespace

bool untangle_node(kernel::Mesh& mesh, Index v) {
  // Trying all triples is quartic in the number of corners: for a fan of many elements it is left to the energy.
  constexpr std::size_t kMostCorners = 48;
  if (!mesh.is_free(v)) return false;
  const std::vector<CornerArea> areas = corner_areas(mesh, v);
  if (areas.size() > kMostCorners) return false;
  // The optimum of three unknowns (x and the smallest area) is a vertex: three areas are equal there. With a
  // dozen or two of corners, trying all triples is simplest.
  Vec2 best = Vec2::Zero();
  double best_area = smallest(areas, best, -std::numeric_limits<double>::infinity());
  const double before = best_area;
  for (std::size_t i = 0; i < areas.size(); ++i)
    for (std::size_t j = i + 1; j < areas.size(); ++j)
      for (std::size_t k = j + 1; k < areas.size(); ++k) {
        const Vec2 a = areas[i].slope - areas[j].slope, b = areas[i].slope - areas[k].slope;
        const double determinant = cross(a, b);
        if (determinant == 0) continue;
        const double p = areas[j].offset - areas[i].offset, q = areas[k].offset - areas[i].offset;
        const Vec2 x((p * b.y() - q * a.y()) / determinant, (a.x() * q - b.x() * p) / determinant);
        const double area = smallest(areas, x, best_area);
        if (area > best_area) best = x, best_area = area;
      }
  if (!(best_area > before)) return false;
  mesh.set_point(v, mesh.point(v) + best);
  return true;
}

namespace {

/// Sine of the corner, or less where its edges differ in length by more than about twenty times: the sine alone
/// would let a node fall onto its neighbour.
double guarded_sine(const Vec2& at, const Vec2& to_next, const Vec2& to_previous) {
  constexpr double kLengthGuard = 10;
  const Vec2 a = to_next - at, b = to_previous - at;
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), area = cross(a, b);
  if (!(aa * bb > 0)) return -1;
  const double sine = area / std::sqrt(aa * bb);
  return std::min(sine, kLengthGuard * 2 * area / (aa + bb));
}

/// The corners of the faces around a node, looked at once, so that trying places costs no walk through the mesh.
class Corners {
 public:
  Corners(const kernel::Mesh& mesh, Index v) {
    Index h = mesh.out(v);
    do {
      if (mesh.face(h) != kNone) add_face(mesh, h);
      h = mesh.rotate_ccw(h);
    } while (h != mesh.out(v));
  }

  /// Elements looked at so far.
  std::size_t work() const { return work_; }

  /// The smallest guarded sine with the node at p, or any that is not above `floor`.
  double smallest(const Vec2& p, double floor) {
    double least = still_;
    for (const Element& e : elements_) {
      ++work_;
      if (!(least > floor)) break;
      const double at_node = guarded_sine(p, e.q, e.r), at_q = guarded_sine(e.q, e.after_q, p),
                   at_r = guarded_sine(e.r, p, e.before_r);
      least = std::min(std::min(least, at_node), std::min(at_q, at_r));
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
                                             mesh.point(mesh.origin(mesh.prev(e)))));
  }

  std::vector<Element> elements_;
  double still_ = 1;  ///< of the corners that do not depend on the node
  std::size_t work_ = 0;
};

double shortest_edge(const kernel::Mesh& mesh, Index v) {
  double shortest = std::numeric_limits<double>::infinity();
  Index h = mesh.out(v);
  do {
    shortest = std::min(shortest, mesh.length(h));
    h = mesh.rotate_ccw(h);
  } while (h != mesh.out(v));
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
  double best_sine = corners.smallest(best, -std::numeric_limits<double>::infinity());
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
    Index h = mesh.out(v);
    do {  // the corner that v is no part of: opposite in a quad, none in a triangle
      if (mesh.is_quad(mesh.face(h)) && is_bad(mesh.next(mesh.next(h)))) return true;
      h = mesh.rotate_ccw(h);
    } while (h != mesh.out(v));
  }
  return false;
}

}  // namespace qmorph::smoothing
