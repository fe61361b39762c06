// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "qmorph/quality.hpp"

namespace qmorph::test {

/// Figures of several meshes together.
struct Pool {
  double quads = 0, shapes = 0;     ///< `shapes`: sum of scaled Jacobians
  double nodes = 0, irregular = 0;  ///< inside

  void add(const QuadMesh& mesh) {
    const Quality quality = measure(mesh);
    quads += double(quality.quads);
    shapes += quality.scaled_jacobian_mean * double(quality.quads);
    nodes += double(quality.interior_nodes);
    irregular += double(quality.irregular_nodes);
  }
  double mean() const { return shapes / quads; }
  double irregular_share() const { return irregular / nodes; }
};

}  // namespace qmorph::test
