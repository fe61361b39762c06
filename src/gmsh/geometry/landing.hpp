// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "gmsh/model/model_mesh.hpp"

namespace qmorph::adapter {

/// A point of a triangle of the input.
struct OnInput {
  Eigen::Vector3d point, weights;
  std::array<Index, 3> corners;  ///< rows of the model's nodes
  double chord = 0;              ///< length of what it is on, if that is longer than the triangle's sides
};

/// The corresponding point of the geometry that the triangles stand for.
struct Landing {
  Eigen::Vector3d point;
  Eigen::Vector2d parameters = kNoParameters;
  bool found = false;  ///< `parameters` are a guess if not, or none, and `point` is the input's
};

/// Brings points of a surface's triangles onto what these stand for.
using Lander = std::function<std::vector<Landing>(std::span<const OnInput>)>;

/// Of a surface of a geometry, or of one with curved elements; empty where flat triangles are all there is. The mesh
/// must outlive it.
Lander find_lander(const ModelMesh& mesh, std::uint32_t entity);

}  // namespace qmorph::adapter
