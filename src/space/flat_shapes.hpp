// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What the faces around a node are like, as its tangent plane shows them.

#include <vector>

#include "space/mesh_on_surface.hpp"

namespace qmorph::space {

/// The faces around a node inside, laid into a plane once: what a move does to their shapes is nearly the same in
/// space, where finding out takes ten times as long.
class FlatShapes {
 public:
  /// `axis_u`, `axis_v`: of the plane, counter-clockwise as the faces are.
  void look_around(const MeshOnSurface& mesh, Index v, const Eigen::Vector3d& axis_u, const Eigen::Vector3d& axis_v);
  /// Sum of the smallest sines of the faces if the node moves by p; NaN if that brings it onto a neighbour.
  double sines(const Vec2& p) const;

 private:
  /// An edge at the node, and the face on its left, which runs: node, end, ..., end of the next spoke.
  struct Spoke {
    Vec2 end;
    Vec2 ahead, behind;   ///< unit vectors along the face's other sides, from the ends of this spoke and of the next
    double opposite = 1;  ///< sine of a quad's corner across from the node
  };
  std::vector<Spoke> spokes_;
};

}  // namespace qmorph::space
