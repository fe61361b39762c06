#pragma once
/// Parts of a divided mesh as regions of their own, and the whole from what they have become.

#include <vector>

#include "engine/parts/divide.hpp"
#include "engine/regions.hpp"

namespace qmorph {

/// The parts as regions. `Region::node` is the vertex of the mesh; interfaces are boundary.
std::vector<Region> take_apart(const kernel::Mesh& mesh, const Division& division);

/// What is needed of the divided mesh to put its parts together again.
struct Whole {
  std::vector<Vec2> points;
  std::vector<Index> fixed;
  std::vector<std::pair<Index, Index>> interface_edges;  ///< lower vertex first, ascending
  Whole(const kernel::Mesh& mesh, const Division& division);
};

/// The whole with the parts' elements: `meshes[i]` is what `parts[i]` has become. Vertices of the divided mesh keep their numbers.
/// No node on an interface is left with two neighbours.
kernel::Mesh join(const Whole& whole, const std::vector<Region>& parts, const std::vector<const kernel::Mesh*>& meshes);

}  // namespace qmorph
