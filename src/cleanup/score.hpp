// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What the connectivity of a mesh is worth: the sum over nodes of (valence - ideal)^2.

#include <vector>

#include "kernel/mesh.hpp"

namespace qmorph::cleanup {

class Score {
 public:
  explicit Score(const kernel::Mesh& mesh) : mesh_(mesh) {}

  /// Edges that should meet at v: 4 inside, on the boundary one more than the quads that share its angle evenly,
  /// round(angle / 90 degrees) but at least 1.
  int ideal(Index v) const { return mesh_.is_boundary(v) ? boundary_ideal(v) : 4; }
  /// At a node of the boundary: the angle of the inside, in (0, 2 pi].
  double inside_angle(Index v) const;
  int excess(Index v) const { return int(mesh_.valence(v)) - ideal(v); }
  /// Gain (positive: better) of a change of v's valence by `by`.
  int gain(Index v, int by) const {
    const int e = excess(v);
    return e * e - (e + by) * (e + by);
  }
  int cost(Index v) const {
    const int e = excess(v);
    return e * e;
  }

 private:
  int boundary_ideal(Index v) const;

  const kernel::Mesh& mesh_;
  mutable std::vector<signed char> boundary_ideal_;  ///< 0: not known yet; boundaries do not move
};

}  // namespace qmorph::cleanup
