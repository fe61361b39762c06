// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How many edges each node of a mesh has, and which nodes are on the boundary.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "qmorph/export.hpp"
#include "qmorph/patch.hpp"

namespace qmorph {

struct NodeDegrees {
  std::vector<int> edges;              ///< distinct edges at each node; 0 if no element uses it
  std::vector<std::uint8_t> boundary;  ///< 1 if one of these edges has a single element
};

/// Counts distinct edges, so the figures mean something on a broken mesh too. Linear: edges are sorted into
/// one bucket for each node, and a bucket holds a handful.
QMORPH_API NodeDegrees node_degrees(std::size_t node_count, std::span<const std::array<Index, 3>> triangles,
                                    std::span<const std::array<Index, 4>> quads);

}  // namespace qmorph
