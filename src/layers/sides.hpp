// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The triangles of a patch, and what lies beyond each of their sides.

#include <numbers>
#include <vector>

#include "qmorph/patch.hpp"

namespace qmorph::layers {

/// Side c belongs to triangle c / 3 and runs from its corner c % 3 to the next one. The patch must outlive it.
/// `crease_angle` (radians, between normals) as Options has it: by default nothing is sharp.
class Sides {
 public:
  explicit Sides(const Patch& patch, double crease_angle = std::numbers::pi);

  static Index next(Index c) { return c % 3 == 2 ? c - 2 : c + 1; }
  static Index previous(Index c) { return c % 3 == 0 ? c + 2 : c - 1; }

  const Patch& patch() const { return patch_; }
  Index count() const { return Index(opposite_.size()); }
  Index from(Index c) const { return patch_.triangles[c / 3][c % 3]; }
  Index to(Index c) const { return from(next(c)); }
  /// The corner across.
  Index apex(Index c) const { return from(previous(c)); }
  const Eigen::Vector3d& point(Index node) const { return patch_.points[node]; }
  double length(Index c) const { return (point(to(c)) - point(from(c))).norm(); }
  /// The same edge's side in the other triangle. kNone for a wall: the boundary, a constraint, a quad that is kept, and
  /// any edge that more than two triangles have.
  Index opposite(Index c) const { return opposite_[c]; }
  bool is_wall(Index c) const { return opposite_[c] == kNone; }
  /// Whether the triangle across belongs to another face of the model, as at the rim of a cylinder. Side c is no wall.
  bool turns_sharply(Index c) const;

  /// The wall side that begins where the wall side c ends, and the one that ends where it begins.
  Index next_wall(Index c) const;
  Index previous_wall(Index c) const;

 private:
  const Patch& patch_;
  const double sharp_cosine_;  ///< between normals: below it a side is sharp
  std::vector<Index> opposite_;
};

}  // namespace qmorph::layers
