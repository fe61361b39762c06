// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Parts of a divided mesh as regions of their own, and the whole from what they have become.

#include <vector>

#include "engine/parts/divide.hpp"
#include "engine/regions.hpp"

namespace qmorph {

/// The parts as regions. `Region::node` is the vertex of the mesh; interfaces are boundary.
std::vector<Region> take_apart(const kernel::Mesh& mesh, const Division& division);

/// What a part has become, without the slots of what it was.
struct PartElements {
  std::vector<Vec2> points;
  std::vector<Index> vertex;                ///< of each point in the whole, or kNone for a new one
  std::vector<std::array<Index, 4>> faces;  ///< by their lowest point; the last corner of a triangle is kNone
  std::vector<std::size_t> boundary;        ///< sides 4 * face + i on the boundary of the part
  /// `node`: as Region::node of the part.
  PartElements(const std::vector<Index>& node, const kernel::Mesh& mesh);
  PartElements() = default;
};

/// What is needed of the divided mesh to put its parts together again.
struct Whole {
  std::vector<Vec2> points;
  std::vector<Index> fixed;
  std::vector<std::pair<Index, Index>> interface_edges;  ///< lower vertex first, ascending
  Whole(const kernel::Mesh& mesh, const Division& division);
};

/// The parts' elements as one mesh. Vertices of the divided mesh keep their numbers. A node on an interface may have
/// two neighbours only.
kernel::Mesh join(Whole whole, std::vector<PartElements> parts);

}  // namespace qmorph
