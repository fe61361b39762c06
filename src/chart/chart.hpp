// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A piece of a surface laid flat, and the way back.

#include "chart/flatten.hpp"
#include "chart/surface_mesh.hpp"

namespace qmorph::chart {

class Chart {
 public:
  using Triangle = space::Background::Triangle;

  explicit Chart(const Piece& piece, int rounds = kAllRounds);
  /// Of triangles that were laid flat already. The arrays must outlive it.
  Chart(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles,
        std::vector<space::Background::Edge> barriers, Flattening flattening);
  Chart(const Chart&) = delete;
  Chart& operator=(const Chart&) = delete;

  const std::vector<Vec2>& flat() const { return flattening_.points; }
  const Flattening& flattening() const { return flattening_; }

  /// A point of the chart. Charts may lie over themselves, so it takes a triangle to say where.
  struct Place {
    Index half = 0;  ///< triangle; of a piece, of its halves
    Eigen::Vector3d weights = Eigen::Vector3d::UnitX();
  };
  /// The place at p, or the nearest to it, that a walk from `hint` comes to.
  Place locate(const Vec2& p, Index hint) const;
  /// The same without a hint: one of the places at p, if there are several. Cost: linear.
  Place nearest_of_all(const Vec2& p) const;
  Eigen::Vector3d to_space(const Place& place) const;
  /// Where the nodes of a mesh in the chart are, by vertex slot; `half` is kNone for dead ones. Those of the chart's
  /// points that have not moved are known, and from there each is found by a walk from a neighbour's place.
  std::vector<Place> places(const kernel::Mesh& mesh) const;
  bool has_moved(const kernel::Mesh& mesh, Index v) const { return v >= flat().size() || mesh.point(v) != flat()[v]; }
  /// Some triangle at a point.
  Index half_at(Index point) const { return half_at_[point]; }

 private:
  Eigen::Vector3d weights(Index half, const Vec2& p) const;
  space::OnTriangle closest(const Vec2& p, Index half) const;
  Place nearest(const Vec2& p, Index hint) const;

  const std::vector<Eigen::Vector3d>& points_;
  const std::vector<Triangle>& triangles_;
  std::vector<space::Background::Edge> barriers_;
  space::Background surface_;
  Flattening flattening_;
  std::vector<Index> half_at_;
};

/// Where the nodes of a mesh in a chart are in space.
struct Lifted {
  std::vector<Eigen::Vector3d> points;  ///< by vertex slot
  std::vector<Index> on;                ///< triangle of the background
};

/// Nodes of the piece that have not moved keep their coordinates to the bit; others come to lie on the background.
Lifted lift(const kernel::Mesh& mesh, const Piece& piece, const Chart& chart, const space::Background& background);

}  // namespace qmorph::chart
