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
      add(q, r);         // corner at v: x, q, r counter-clockwise
      if (mesh.degree(mesh.face(h)) == 4) {
        add(q, after_q);   // corner at q: q, after_q, x
        add(before_r, r);  // corner at r: r, x, before_r
      }
    }
    h = mesh.rotate_ccw(h);
  } while (h != mesh.out(v));
  return areas;
}

double smallest(const std::vector<CornerArea>& areas, const Vec2& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& a : areas) least = std::min(least, a.at(x));
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
  double best_area = smallest(areas, best);
  const double before = best_area;
  for (std::size_t i = 0; i < areas.size(); ++i)
    for (std::size_t j = i + 1; j < areas.size(); ++j)
      for (std::size_t k = j + 1; k < areas.size(); ++k) {
        const Vec2 a = areas[i].slope - areas[j].slope, b = areas[i].slope - areas[k].slope;
        const double determinant = cross(a, b);
        if (determinant == 0) continue;
        const double p = areas[j].offset - areas[i].offset, q = areas[k].offset - areas[i].offset;
        const Vec2 x((p * b.y() - q * a.y()) / determinant, (a.x() * q - b.x() * p) / determinant);
        const double area = smallest(areas, x);
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

double guarded_sine_around(const kernel::Mesh& mesh, Index v) {
  double least = 1;
  Index h = mesh.out(v);
  do {
    if (mesh.face(h) != kNone) {
      const Index start = h;
      Index e = h;
      do {
        least = std::min(least, guarded_sine(mesh.point(mesh.origin(e)), mesh.point(mesh.target(e)),
                                             mesh.point(mesh.origin(mesh.prev(e)))));
        e = mesh.next(e);
      } while (e != start);
    }
    h = mesh.rotate_ccw(h);
  } while (h != mesh.out(v));
  return least;
}

}  // namespace

bool raise_smallest_sine(kernel::Mesh& mesh, Index v) {
  if (!mesh.is_free(v)) return false;
  constexpr int kDirections = 8, kShrinkings = 6, kMostRounds = 40;
  constexpr double kFirstStep = 0.25, kLeastGain = 1e-6;
  double shortest = std::numeric_limits<double>::infinity();
  Index h = mesh.out(v);
  do {
    shortest = std::min(shortest, mesh.length(h));
    h = mesh.rotate_ccw(h);
  } while (h != mesh.out(v));

  const Vec2 start = mesh.point(v);
  const bool was_valid = mesh.is_valid_star(v);
  Vec2 best = start;
  double best_sine = guarded_sine_around(mesh, v);
  double step = kFirstStep * shortest;
  constexpr double kDiagonal = 0.70710678118654752;
  static constexpr double kCompass[kDirections][2] = {
      {1, 0}, {kDiagonal, kDiagonal}, {0, 1}, {-kDiagonal, kDiagonal},
      {-1, 0}, {-kDiagonal, -kDiagonal}, {0, -1}, {kDiagonal, -kDiagonal}};
  for (int shrinking = 0, rounds = 0; shrinking < kShrinkings && rounds < kMostRounds; ++rounds) {
    const Vec2 centre = best;
    for (const auto& d : kCompass) {
      mesh.set_point(v, centre + step * Vec2(d[0], d[1]));
      const double sine = guarded_sine_around(mesh, v);
      if (sine > best_sine + kLeastGain) best = mesh.point(v), best_sine = sine;
    }
    if (best == centre) step /= 2, ++shrinking;
  }
  mesh.set_point(v, best);
  // The guard on lengths may have paid for a rise with a corner's sine.
  if (was_valid && !mesh.is_valid_star(v)) mesh.set_point(v, best = start);
  return best != start;
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
