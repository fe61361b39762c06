// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A piece of a surface laid flat, and the way back.

#include "chart/flatten.hpp"
#include "chart/surface_mesh.hpp"

namespace qmorph::chart {

class Chart {
 public:
  explicit Chart(const Piece& piece, int rounds = kAllRounds);
  Chart(const Chart&) = delete;
  Chart& operator=(const Chart&) = delete;

  const std::vector<Vec2>& flat() const { return flattening_.points; }
  const Flattening& flattening() const { return flattening_; }

  /// A point of the chart. Charts may lie over themselves, so it takes a triangle to say where.
  struct Place {
    Index half = 0;  ///< of the piece
    Eigen::Vector3d weights = Eigen::Vector3d::UnitX();
  };
  /// The place at p, or the nearest to it, that a walk from `hint` comes to.
  Place locate(const Vec2& p, Index hint) const;
  /// The same without a hint: one of the places at p, if there are several. Cost: linear.
  Place nearest_of_all(const Vec2& p) const;
  Eigen::Vector3d to_space(const Place& place) const;
  /// Some triangle at a point of the piece.
  Index half_at(Index point) const { return half_at_[point]; }

 private:
  Eigen::Vector3d weights(Index half, const Vec2& p) const;
  space::OnTriangle closest(const Vec2& p, Index half) const;
  Place nearest(const Vec2& p, Index hint) const;

  const Piece& piece_;
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
