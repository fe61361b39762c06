// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Where layers and the quads of the front meet, and which cells of layers are poor themselves.

#include <vector>

#include "layers/find_layers.hpp"

namespace qmorph::layers {

/// Scaled Jacobians of some quads.
struct Shapes {
  std::size_t poor = 0;  ///< under 0.3
  double least = 1, mean = 1;
};

/// Nodes are those of layers, as rows of `Patch::points`.
struct Meetings {
  Shapes of_front, of_all;          ///< what the front has made beside layers; that and the layers
  std::vector<Index> narrow_nodes;  ///< where poor quads of the front have a poor corner
  /// Where cells slant: those that are poor, and others that hang together with them.
  std::vector<Index> slanting_nodes;
};

/// \param given how many quads the patch had before its layers
/// \param mesh what has become of `layers.patch`
Meetings look_at_meetings(const Layers& layers, std::size_t given, const QuadMesh& mesh);

}  // namespace qmorph::layers
