// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/mesh_normals.hpp"

#include "space/unit.hpp"

namespace qmorph::space {

using Eigen::Vector3d;

MeshNormals::MeshNormals(std::span<const Vector3d> points, const ElementSides& sides) : sides_(sides) {
  const auto corner = [&](Index element, Index i) -> const Vector3d& { return points[sides.node(4 * element + i)]; };
  of_element_.reserve(sides.elements());
  for (Index e = 0; e < sides.elements(); ++e)
    of_element_.push_back(sides.is_triangle(e)
                              ? element_normal<3>({corner(e, 0), corner(e, 1), corner(e, 2)})
                              : element_normal<4>({corner(e, 0), corner(e, 1), corner(e, 2), corner(e, 3)}));
  fan_.assign(sides.slots(), kNone);
  for (Index side = 0; side < sides.slots(); ++side) {
    if (fan_[side] != kNone || sides.node(side) == kNone) continue;
    Vector3d sum = Vector3d::Zero();
    sides.for_fan(side, [&](Index other) {
      sum += of_element_[other / 4];
      fan_[other] = Index(of_fan_.size());
    });
    of_fan_.push_back(unit(sum));
  }
}

template <std::size_t N>
CornerNormals<N> MeshNormals::of(Index element) const {
  CornerNormals<N> normals;
  normals.whole = 2 * of_element_[element];
  for (Index i = 0; i < N; ++i) {
    normals.at[i] = of_fan_[fan_[4 * element + i]];
    if (const Index other = sides_.opposite(4 * element + i); other != kNone) normals.whole += of_element_[other / 4];
  }
  normals.whole = unit(normals.whole);
  return normals;
}

template CornerNormals<3> MeshNormals::of<3>(Index) const;
template CornerNormals<4> MeshNormals::of<4>(Index) const;

}  // namespace qmorph::space
