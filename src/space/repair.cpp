// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/repair.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/predicates.hpp"

namespace qmorph::space {
namespace {

using Eigen::Vector3d;

/// Smallest sine around a node, or less where edges at a corner differ in length by more than about twenty times: the
/// sine alone would let a node fall onto its neighbour.
double guarded_sine_around(const MeshOnSurface& mesh, Index v, bool exact) {
  constexpr double kLengthGuard = 20;
  double least = exact ? mesh.exact_sine_around(v) : mesh.smallest_sine_around(v);
  mesh.for_sides_around(v, [&](Index first) {
    Index side = first;
    do {
      const Vector3d& at = mesh.point(mesh.node(side));
      const Vector3d a = mesh.point(mesh.node(mesh.next(side))) - at;
      const Vector3d b = mesh.point(mesh.node(mesh.previous(side))) - at;
      const double squares = a.squaredNorm() + b.squaredNorm();
      least = std::min(least, squares > 0 ? kLengthGuard * a.cross(b).norm() / squares : -1);
      side = mesh.next(side);
    } while (side != first);
  });
  return least;
}

/// Two axes of the tangent plane at a node.
std::pair<Vector3d, Vector3d> tangents(const Vector3d& normal) {
  const Vector3d axis = std::abs(normal.x()) < 0.6 ? Vector3d::UnitX() : Vector3d::UnitY();
  const Vector3d u = (axis - axis.dot(normal) * normal).normalized();
  return {u, normal.cross(u)};
}

class Compass {
 public:
  Compass(MeshOnSurface& mesh, std::size_t looks) : mesh_(mesh), looks_(looks) {}

  bool has_looks() const { return looks_ > 0; }

  /// True if the node moved.
  bool raise(Index v, bool exact) {
    constexpr int kShrinkings = 6, kMostRounds = 40;
    constexpr double kFirstStep = 0.25, kLeastGain = 1e-6;
    if (!mesh_.is_free(v) || mesh_.normal(v).isZero()) return false;
    const MeshOnSurface::Place start = mesh_.place(v);
    MeshOnSurface::Place best = start;
    double best_sine = guarded_sine_around(mesh_, v, exact), step = kFirstStep * shortest_edge(v);
    bool moved = false;
    for (int shrinking = 0, round = 0; shrinking < kShrinkings && round < kMostRounds && has_looks(); ++round) {
      const auto [u, w] = tangents(best.normal);
      const MeshOnSurface::Place centre = best;
      bool better = false;
      for (const auto& d : kCompass) {
        mesh_.move(v, centre);
        mesh_.move(v, mesh_.foot(v, centre.point + step * (d[0] * u + d[1] * w)));
        const double sine = guarded_sine_around(mesh_, v, exact);
        if (looks_ > 0) --looks_;
        if (sine > best_sine + kLeastGain) best = mesh_.place(v), best_sine = sine, better = true;
      }
      moved = moved || better;
      if (!better) step /= 2, ++shrinking;
    }
    mesh_.move(v, best);
    return moved;
  }

 private:
  static constexpr double kDiagonal = 0.70710678118654752;
  static constexpr double kCompass[8][2] = {{1, 0},  {kDiagonal, kDiagonal},   {0, 1},  {-kDiagonal, kDiagonal},
                                            {-1, 0}, {-kDiagonal, -kDiagonal}, {0, -1}, {kDiagonal, -kDiagonal}};

  double shortest_edge(Index v) const {
    double shortest = std::numeric_limits<double>::infinity();
    mesh_.for_sides_around(v, [&](Index side) {
      shortest = std::min(shortest, (mesh_.point(mesh_.node(mesh_.next(side))) - mesh_.point(v)).norm());
    });
    return shortest;
  }

  MeshOnSurface& mesh_;
  std::size_t looks_;
};

}  // namespace

std::vector<PoorFace> find_poor(const MeshOnSurface& mesh, double sine) {
  std::vector<PoorFace> poor;
  for (Index f = 0; f < mesh.faces(); ++f) {
    const bool is_quad = chart::degree(mesh.mesh().faces[f]) == 4;
    const double least = std::max(sine, is_quad ? kStraightSine : kDegenerateSine);
    if (mesh.is_clearly_above(f, least)) continue;
    const double exact = mesh.exact_sine(f);
    if (!(exact > least)) poor.push_back({exact, f});
  }
  std::stable_sort(poor.begin(), poor.end(), [](const PoorFace& a, const PoorFace& b) { return a.sine < b.sine; });
  return poor;
}

std::vector<Index> raise_poor(MeshOnSurface& mesh, const SmoothingOptions& options) {
  constexpr int kPasses = 3;
  constexpr std::size_t kFewLooks = 20'000;
  Compass compass(mesh, kFewLooks + 2 * std::size_t(mesh.faces()));
  std::vector<Index> moved;
  for (int pass = 0; pass < kPasses; ++pass) {
    const std::size_t before = moved.size();
    for (const PoorFace& poor : find_poor(mesh, options.target_quality)) {
      const Index degree = chart::degree(mesh.mesh().faces[poor.face]);
      const bool is_straight = poor.sine <= kStraightSine;
      for (Index i = 0; i < degree && compass.has_looks(); ++i)
        if (const Index v = mesh.node(4 * poor.face + i);
            (is_straight || mesh.is_to_be_smoothed(v)) && compass.raise(v, is_straight))
          moved.push_back(v);
    }
    if (moved.size() == before) break;
  }
  return moved;
}

}  // namespace qmorph::space
