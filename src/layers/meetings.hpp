// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Where layers and the quads of the front meet.

#include <vector>

#include "layers/find_layers.hpp"

namespace qmorph::layers {

/// What the front has made beside layers.
struct Meetings {
  std::size_t poor = 0;             ///< quads with a scaled Jacobian under 0.3
  double least = 1, mean = 1;       ///< scaled Jacobian
  std::vector<Index> narrow_nodes;  ///< of layers, where such quads have a poor corner: rows of `Patch::points`
};

/// \param given how many quads the patch had before its layers
/// \param mesh what has become of `layers.patch`
Meetings look_at_meetings(const Layers& layers, std::size_t given, const QuadMesh& mesh);

}  // namespace qmorph::layers
