// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The triangles of an input surface, by which everything in space is measured: they define where the surface is and
/// which way is up. They are never edited.

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "qmorph/export.hpp"
#include "qmorph/index.hpp"
#include "space/closest_point.hpp"

namespace qmorph::space {

/// A point on the surface.
struct Foot : OnTriangle {
  Index triangle = kNone;
};

/// Adjacency, normals and closest points of a surface's triangles, whose sides are numbered 3 * triangle + i, from
/// corner i to the next. Arrays that it is made of must outlive it. Cost: linear in the number of triangles.
class QMORPH_API Background {
 public:
  using Triangle = std::array<Index, 3>;
  using Edge = std::array<Index, 2>;

  /// `barriers` are edges (rows of `points`) that part the surface, as constraints and creases do: no walk crosses
  /// them, and normals of the two sides are not mixed. So do edges with one triangle, with three or more, and those
  /// whose triangles are not oriented alike.
  Background(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles,
             std::span<const Edge> barriers = {});

  std::span<const Eigen::Vector3d> points() const { return points_; }
  std::span<const Triangle> all_corners() const { return triangles_; }
  Index triangles() const { return Index(triangles_.size()); }
  const Triangle& corners(Index t) const { return triangles_[t]; }
  const Eigen::Vector3d& point(Index row) const { return points_[row]; }
  const Eigen::Vector3d& corner(Index t, int i) const { return points_[triangles_[t][i]]; }

  /// The same edge's side in the other triangle, or kNone at a barrier.
  Index opposite(Index side) const { return opposite_[side]; }
  /// The triangle across side i of t, or kNone.
  Index neighbour(Index t, int i) const {
    const Index side = opposite_[3 * t + i];
    return side == kNone ? kNone : side / 3;
  }

  /// Unit normal of a triangle; zero if it has no area.
  const Eigen::Vector3d& normal(Index t) const { return normals_[t]; }
  /// Unit normal of a triangle weighed 3 and its neighbours weighed 1: one bad triangle does not decide which way is
  /// up.
  Eigen::Vector3d normal_near(Index t) const;
  /// Unit normal of a node, by the areas of the triangles around it on this side of the barriers.
  const Eigen::Vector3d& corner_normal(Index t, int i) const { return fan_normals_[fans_[3 * t + i]]; }
  /// Unit normal that changes from node to node, at the point of t with these weights.
  Eigen::Vector3d smooth_normal(Index t, const Eigen::Vector3d& weights) const;

  /// The triangles around the corners of t all have nearly the normal of their corner, so there is no need to look
  /// closer.
  bool is_smooth(Index t) const { return clear_cosine_[t] <= kClearOfSmooth; }
  /// An element's corner near t that has at least this cosine to the normals of nodes there turns the way that every
  /// triangle around says; more than 1 where these differ too much for that.
  double clear_cosine(Index t) const { return clear_cosine_[t]; }

  /// Triangles around a node that are joined across edges that are no barriers make a fan: a node has several where
  /// barriers or touching parts of the boundary meet. Number of the fan of corner i of t, from 0 to fans() - 1.
  Index fan(Index t, int i) const { return fans_[3 * t + i]; }
  Index fans() const { return Index(fan_normals_.size()); }

  /// Calls visit(side) for the side that starts at this corner and those of the other triangles of its fan, at most so
  /// many each way round.
  template <class Visit>
  void for_fan(Index side, Index most, const Visit& visit) const;

  /// The point of triangle t that is closest to p.
  Foot foot_on(Index t, const Eigen::Vector3d& p) const;
  /// The closest point that a walk downhill from `hint` finds: each step goes to that triangle around which is nearest
  /// to p. It crosses no barrier and takes a bounded number of steps. Near the surface that is the closest point of all
  /// on this side of the barriers, but where the surface comes back to itself nearer than it is curved.
  Foot walk(const Eigen::Vector3d& p, Index hint) const;

 private:
  static constexpr double kClearOfSmooth = 0.5;

  void add_fans();
  void find_clear_cosines();
  std::array<double, 3> squared_heights(const Foot& foot) const;
  static Index next(Index side) { return side % 3 == 2 ? side - 2 : side + 1; }
  static Index previous(Index side) { return side % 3 == 0 ? side + 2 : side - 1; }

  std::span<const Eigen::Vector3d> points_;
  std::span<const Triangle> triangles_;
  std::vector<Index> opposite_;               ///< by side
  std::vector<Eigen::Vector3d> normals_;      ///< by triangle
  std::vector<Index> fans_;                   ///< by corner
  std::vector<Eigen::Vector3d> fan_normals_;  ///< by fan
  std::vector<double> clear_cosine_;          ///< by triangle
};

template <class Visit>
void Background::for_fan(Index side, Index most, const Visit& visit) const {
  visit(side);
  Index e = opposite_[side];
  for (Index i = 0; e != kNone && i < most; ++i, e = opposite_[e]) {
    e = next(e);
    if (e == side) return;  // all round
    visit(e);
  }
  e = opposite_[previous(side)];
  for (Index i = 0; e != kNone && i < most; ++i, e = opposite_[previous(e)]) {
    if (e == side) return;  // a fan that is longer than `most`, from the other end
    visit(e);
  }
}

}  // namespace qmorph::space
