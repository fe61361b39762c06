// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Edges and elements that several surfaces have.

#include <cstdint>
#include <map>
#include <vector>

#include "gmsh/model/model_mesh.hpp"

namespace qmorph::adapter {

/// Edges of the mesh that nothing may remove: those with a line element on them, and those that several surfaces
/// share. MSH files know nothing of embedded curves, so that the elements have to say it. An edge that is inside each
/// of them and leads from a curve to a curve, both between the same surfaces, only happens to be in several: where
/// these are narrow.
class FixedEdges {
 public:
  FixedEdges(const ModelMesh& mesh, const NodeUse& use);
  bool contains(Index row_a, Index row_b) const;

 private:
  std::vector<std::uint64_t> keys_;  ///< sorted
  std::vector<bool> touched_;        ///< rows that such an edge ends at: most edges of a mesh need no search
};

/// An element that another surface has as well.
struct CommonElement {
  std::uint32_t other = 0;  ///< index into ModelMesh::entities
  Index row = kNone;        ///< one of its nodes
};

/// Surfaces that have an element in common with another: neither could be changed and still fit the other. A triangle
/// whose corners are on curves between the two may happen to be in both; but not all elements of a surface.
std::map<std::uint32_t, CommonElement> find_common_elements(const ModelMesh& mesh, const NodeUse& use);

}  // namespace qmorph::adapter
