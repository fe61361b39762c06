// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Surfaces that lie over one another, or over themselves.

#include <Eigen/Core>
#include <optional>

#include "gmsh/model/model_mesh.hpp"

namespace qmorph::adapter {

struct Overlap {
  int surface = 0;  ///< one of those that take part
  Eigen::Vector3d where = Eigen::Vector3d::Zero();
};

/// Looks at planar surfaces, those in one plane together. Finds what covers a part of the plane twice where the outline
/// of the one runs through the other, or through nothing at all; not two sheets with the same outline nodes.
/// Cost: linear, plus the length of the outline times the number of its edges above one another, which is limited by a
/// budget.
std::optional<Overlap> find_overlap(const ModelMesh& mesh);

}  // namespace qmorph::adapter
