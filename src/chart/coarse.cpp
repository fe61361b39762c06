// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/coarse.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "chart/flatten.hpp"
#include "chart/topology.hpp"
#include "kernel/sort_unique.hpp"

namespace qmorph::chart {
namespace {

/// Edges between two points that are kept.
constexpr int kStep = 4;
/// Fewer coarse triangles say too little; and fewer of the piece are laid flat as fast at once.
constexpr std::size_t kFewTriangles = 60, kWorthwhile = 2000;
/// With a larger distortion, few points are no good place to start from.
constexpr double kMostByFew = 1.3;
/// All triangles together are distorted as much as the coarse ones are, by so much and by this share of it more. Where
/// it is more than that, they should lie flatter than the coarse ones can tell, as on a cylinder, or these are no image
/// of the piece.
constexpr double kMoreDistortion = 1e-3, kShareMore = 0.03;

using Triangle = space::Background::Triangle;

/// Points of a piece by point, each edge from both ends.
class Neighbours {
 public:
  explicit Neighbours(const Piece& piece) : first_(piece.points.size() + 1, 0), list_(6 * piece.halves.size()) {
    for (const Triangle& t : piece.halves)
      for (Index v : t) first_[v] += 2;
    Index sum = 0;
    for (Index& at : first_) sum += at, at = sum;
    for (const Triangle& t : piece.halves)
      for (int i = 0; i < 3; ++i) {
        list_[--first_[t[i]]] = t[(i + 1) % 3];
        list_[--first_[t[i]]] = t[(i + 2) % 3];
      }
  }
  std::span<const Index> of(Index v) const { return {list_.data() + first_[v], list_.data() + first_[v + 1]}; }

 private:
  std::vector<Index> first_, list_;
};

class Thinning {
 public:
  explicit Thinning(const Piece& piece) : piece_(piece), neighbours_(piece), covered_(piece.points.size(), 0) {}

  /// The points that are kept.
  const std::vector<Index>& run() {
    for (const std::vector<Index>& loop : loops_of(piece_))
      for (std::size_t k = 0; k < loop.size(); k += kStep) keep(loop[k]);
    for (Index v = 0; v < piece_.points.size(); ++v)
      if (!covered_[v]) keep(v);
    return kept_;
  }

  /// By point: the number of that of some points which is fewest edges away.
  std::vector<Index> nearest_of(const std::vector<Index>& some) const {
    std::vector<Index> nearest(piece_.points.size(), kNone), order = some;
    for (Index k = 0; k < some.size(); ++k) nearest[some[k]] = k;
    for (std::size_t k = 0; k < order.size(); ++k)
      for (Index w : neighbours_.of(order[k]))
        if (nearest[w] == kNone) nearest[w] = nearest[order[k]], order.push_back(w);
    return nearest;
  }

 private:
  void keep(Index v) {
    kept_.push_back(v);
    covered_[v] = kStep;
    std::vector<Index> ring{v}, next;
    for (char left = kStep - 1; left > 0; --left, std::swap(ring, next)) {
      next.clear();
      for (Index a : ring)
        for (Index b : neighbours_.of(a))
          if (covered_[b] < left) covered_[b] = left, next.push_back(b);
    }
  }

  const Piece& piece_;
  const Neighbours neighbours_;
  std::vector<char> covered_;  ///< by point: how many edges farther a kept one near it reaches, and 1
  std::vector<Index> kept_;
};

/// A piece by a few of its points.
struct CoarsePiece {
  std::vector<Index> kept;  ///< points of the piece
  std::vector<Eigen::Vector3d> points;
  std::vector<Triangle> triangles;
};

/// Nothing if too few are left.
std::optional<CoarsePiece> coarsened(const Piece& piece, Thinning& thinning) {
  const std::vector<Index>& kept = thinning.run();
  const std::vector<Index> nearest = thinning.nearest_of(kept);
  CoarsePiece coarse;
  for (const Triangle& t : piece.halves) {
    Triangle few{nearest[t[0]], nearest[t[1]], nearest[t[2]]};
    if (few[0] == few[1] || few[1] == few[2] || few[2] == few[0]) continue;
    std::rotate(few.begin(), std::min_element(few.begin(), few.end()), few.end());
    coarse.triangles.push_back(few);
  }
  sort_unique(coarse.triangles);
  if (coarse.triangles.size() < kFewTriangles) return {};
  std::vector<Index> number(kept.size(), kNone);
  for (Triangle& t : coarse.triangles)
    for (Index& v : t) {
      if (number[v] == kNone) {
        number[v] = Index(coarse.kept.size());
        coarse.kept.push_back(kept[v]);
        coarse.points.push_back(piece.points[kept[v]]);
      }
      v = number[v];
    }
  return coarse;
}

/// How what is around each point of a surface got to its place in a chart, as far as that is linear.
class Around {
 public:
  using Jacobian = Eigen::Matrix<double, 2, 3>;

  Around(const space::Background& surface, const std::vector<Vec2>& flat) : surface_(surface), flat_(flat) {
    const std::size_t points = surface.points().size();
    std::vector<Eigen::Vector3d> normals(points, Eigen::Vector3d::Zero());
    std::vector<Eigen::Matrix3d> squares(points, Eigen::Matrix3d::Zero());
    jacobians_.assign(points, Jacobian::Zero());
    for (Index t = 0; t < surface.triangles(); ++t)
      for (int i = 0; i < 3; ++i) {
        const Index v = surface.corners(t)[i];
        normals[v] += (surface.corner(t, 1) - surface.corner(t, 0)).cross(surface.corner(t, 2) - surface.corner(t, 0));
        for (int k = 1; k < 3; ++k) {
          const Index w = surface.corners(t)[(i + k) % 3];
          const Eigen::Vector3d side = surface.point(w) - surface.point(v);
          const Vec2 move = flat[w] - flat[v];
          squares[v] += side * side.transpose();
          jacobians_[v] += Eigen::Vector2d(move.x(), move.y()) * side.transpose();
        }
      }
    // Along the normal nothing is known: nothing moves.
    for (std::size_t v = 0; v < points; ++v) {
      const Eigen::Vector3d normal = normals[v].normalized();
      const Eigen::Matrix3d along = Eigen::Matrix3d::Identity() - normal * normal.transpose();
      const Eigen::Matrix3d square = along * squares[v] * along + squares[v].trace() * normal * normal.transpose();
      jacobians_[v] = jacobians_[v] * along * square.inverse() * along;
    }
  }

  Vec2 at(Index near, const Eigen::Vector3d& p) const {
    const Eigen::Vector2d move = jacobians_[near] * (p - surface_.point(near));
    return flat_[near] + Vec2(move.x(), move.y());
  }

 private:
  const space::Background& surface_;
  const std::vector<Vec2>& flat_;
  std::vector<Jacobian> jacobians_;
};

}  // namespace

std::optional<double> coarse_distortion(const Piece& piece) {
  Thinning thinning(piece);
  const std::optional<CoarsePiece> coarse = coarsened(piece, thinning);
  if (!coarse) return {};
  const Flattening flat = flatten(space::Background(coarse->points, coarse->triangles), coarse->points.size());
  if (flat.flipped > 0) return {};
  return flat.distortion;
}

std::optional<Flattening> flatten_by_few(const Piece& piece, const space::Background& surface) {
  if (piece.halves.size() < kWorthwhile) return {};
  Thinning thinning(piece);
  const std::optional<CoarsePiece> coarse = coarsened(piece, thinning);
  if (!coarse) return {};
  const space::Background coarse_surface(coarse->points, coarse->triangles);
  const Flattening flat = flatten(coarse_surface, coarse->points.size());
  if (flat.flipped > 0 || flat.distortion > kMostByFew) return {};
  const std::vector<Index> nearest = thinning.nearest_of(coarse->kept);
  const Around around(coarse_surface, flat.points);
  std::vector<Vec2> points(piece.points.size(), Vec2::Zero());
  std::vector<double> count(points.size(), 0);
  for (const Triangle& t : piece.halves)
    for (Index w : t) {
      if (nearest[w] == kNone) return {};
      // The mean of what those near each point make of it has no steps.
      for (Index v : t) points[v] += around.at(nearest[w], piece.points[v]), ++count[v];
    }
  for (std::size_t v = 0; v < points.size(); ++v) points[v] *= 1 / count[v];
  std::optional<Flattening> all = flatten_from(surface, std::move(points));
  const double most = flat.distortion + kMoreDistortion + kShareMore * (flat.distortion - 1);
  if (all && all->distortion > most) return {};
  return all;
}

}  // namespace qmorph::chart
