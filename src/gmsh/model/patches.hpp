// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// From the mesh of a model to what the engine takes.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gmsh/model/model_mesh.hpp"
#include "gmsh/model/shared.hpp"
#include "qmorph/error.hpp"
#include "qmorph/patch.hpp"

namespace qmorph::adapter {

/// A set of elements of one surface that hang together by edges. Parts may lie in different planes and have
/// different orientations, which a file with one elementary tag for everything does have.
struct SurfacePart {
  Patch patch;
  std::vector<Index> rows;             ///< of the model's nodes, one for each point of the patch
  std::vector<std::size_t> quad_tags;  ///< of the patch's quads
};

/// One surface, ready to convert.
struct SurfaceMesh {
  std::uint32_t entity = 0;  ///< index into ModelMesh::entities
  std::vector<SurfacePart> parts;
  std::vector<std::string> warnings;
  std::string edge_of_many;   ///< where more than two elements meet at an edge, or empty
  bool quads_may_go = false;  ///< the quads of the input are not kept: what they are made into takes their tags
};

/// Reads one surface: parts, constraints, fixed nodes. Triangles that are oriented against the others
/// of their part are turned, with a warning.
/// \throws SurfaceError if it has elements that are not triangles and quads of one order, bounds a volume with
///         elements, is not a manifold, has no orientation, has a node at no place (NaN), or refers to a node that does
///         not exist. `local` is scratch: as long as the mesh has nodes, all kNone before and after.
SurfaceMesh read_surface(const ModelMesh& mesh, const NodeUse& use, const FixedEdges& fixed_edges, std::uint32_t entity,
                         std::vector<Index>& local);

/// What is said of a quad two sides of which cross.
SurfaceError crossed_quad(std::size_t tag, const std::array<Eigen::Vector3d, 4>& corners);

}  // namespace qmorph::adapter
