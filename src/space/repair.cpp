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

/// Whose normals say whether a corner is good.
enum class Judge { surface, surface_closely, element_too };

/// Smallest sine around a node, or less where edges at a corner differ in length by more than about twenty times: the
/// sine alone would let a node fall onto its neighbour. What is not above `least_wanted` need not be exact: the
/// surface's normals are looked up only as long as the sine may still be above it.
double guarded_sine_around(const MeshOnSurface& mesh, Index v, Judge judge, double least_wanted) {
  constexpr double kLengthGuard = 20;
  double least = 1, most = 1;  // whatever the normals are, it is at most the second one
  mesh.for_sides_around(v, [&](Index first) {
    if (!(most > least_wanted)) return;
    Index side = first;
    do {
      const Vector3d& at = mesh.point(mesh.node(side));
      const Vector3d a = mesh.point(mesh.node(mesh.next(side))) - at;
      const Vector3d b = mesh.point(mesh.node(mesh.previous(side))) - at;
      const double a2 = a.squaredNorm(), b2 = b.squaredNorm(), area = a.cross(b).norm();
      least = std::min(least, a2 + b2 > 0 ? kLengthGuard * area / (a2 + b2) : -1);
      most = std::min({most, least, a2 * b2 > 0 ? area / std::sqrt(a2 * b2) : least});
      side = mesh.next(side);
    } while (side != first);
    if (judge == Judge::element_too) least = std::min(least, mesh.own_sine(first / 4)), most = std::min(most, least);
  });
  if (!(most > least_wanted)) return most;
  mesh.for_sides_around(v, [&](Index side) {
    if (!(least > least_wanted)) return;
    least = std::min(least, judge == Judge::surface_closely ? mesh.exact_sine(side / 4) : mesh.smallest_sine(side / 4));
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
  /// `looks`: places to try; `exact_looks`: times that an element is looked at closely.
  Compass(MeshOnSurface& mesh, std::size_t looks, std::size_t exact_looks)
      : mesh_(mesh), looks_(looks), most_exact_(mesh.exact_looks() + exact_looks) {}

  bool has_looks() const { return looks_ > 0 && mesh_.exact_looks() < most_exact_; }

  /// True if the node moved.
  bool raise(Index v, Judge judge) {
    constexpr int kShrinkings = 6, kMostRounds = 40;
    constexpr double kFirstStep = 0.25, kLeastGain = 1e-6;
    if (!mesh_.is_free(v) || mesh_.normal(v).isZero()) return false;
    const MeshOnSurface::Place start = mesh_.place(v);
    MeshOnSurface::Place best = start;
    double best_sine = guarded_sine_around(mesh_, v, judge, -1), step = kFirstStep * shortest_edge(v);
    bool moved = false;
    for (int shrinking = 0, round = 0; shrinking < kShrinkings && round < kMostRounds && has_looks(); ++round) {
      const auto [u, w] = tangents(best.normal);
      const MeshOnSurface::Place centre = best;
      bool better = false;
      for (const auto& d : kCompass) {
        mesh_.move(v, centre);
        mesh_.move(v, mesh_.foot(v, centre.point + step * (d[0] * u + d[1] * w)));
        const double sine = guarded_sine_around(mesh_, v, judge, best_sine);
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
  const std::size_t most_exact_;
};

void sort_by_sine(std::vector<PoorFace>& poor) {
  std::stable_sort(poor.begin(), poor.end(), [](const PoorFace& a, const PoorFace& b) { return a.sine < b.sine; });
}

}  // namespace

std::vector<PoorFace> find_poor(const MeshOnSurface& mesh, double sine) {
  std::vector<PoorFace> poor;
  for (Index f = 0; f < mesh.faces(); ++f) {
    const bool is_quad = chart::degree(mesh.mesh().faces[f]) == 4;
    const double least = std::max(sine, is_quad ? kStraightSine : kDegenerateSine);
    if (mesh.is_clearly_above(f, least)) continue;
    const double exact = mesh.exact_sine(f);
    if (!(exact > least)) poor.push_back({exact, f, exact <= kStraightSine});
  }
  sort_by_sine(poor);
  return poor;
}

namespace {

/// The faces that are poor by their own normals and clearly better by the surface's.
std::vector<PoorFace> find_bent(const MeshOnSurface& mesh, double sine) {
  constexpr double kClearlyWorse = 0.7;
  std::vector<PoorFace> bent;
  for (Index f = 0; f < mesh.faces(); ++f)
    if (const double own = mesh.own_sine(f); own < sine && own < kClearlyWorse * mesh.smallest_sine(f))
      bent.push_back({own, f, false});
  sort_by_sine(bent);
  return bent;
}

/// `find`: the faces to be raised; `judge`: by which they are poor, if they are not straight.
template <class Find>
std::vector<Index> raise(MeshOnSurface& mesh, Judge judge, const Find& find) {
  constexpr int kPasses = 3;
  constexpr std::size_t kFewLooks = 20'000, kFewExact = 2'000, kExactEach = 40;
  const std::size_t faces = mesh.faces();
  Compass compass(mesh, kFewLooks + 2 * faces, kFewExact + kExactEach * faces);
  std::vector<Index> moved;
  for (int pass = 0; pass < kPasses; ++pass) {
    const std::size_t before = moved.size();
    for (const PoorFace& poor : find()) {
      const Index degree = chart::degree(mesh.mesh().faces[poor.face]);
      const Judge own = poor.is_straight ? Judge::surface_closely : judge;
      for (Index i = 0; i < degree && compass.has_looks(); ++i)
        if (const Index v = mesh.node(4 * poor.face + i);
            (poor.is_straight || mesh.is_to_be_smoothed(v)) && compass.raise(v, own))
          moved.push_back(v);
    }
    if (moved.size() == before) break;
  }
  return moved;
}

}  // namespace

std::vector<Index> raise_poor(MeshOnSurface& mesh, const SmoothingOptions& options) {
  return raise(mesh, Judge::surface, [&] { return find_poor(mesh, options.target_quality); });
}

void raise_bent(MeshOnSurface& mesh, const SmoothingOptions& options) {
  raise(mesh, Judge::element_too, [&] { return find_bent(mesh, options.target_quality); });
}

}  // namespace qmorph::space
