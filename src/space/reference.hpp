// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "qmorph/patch.hpp"
#include "space/background.hpp"

namespace qmorph::space {

/// A patch as background: its triangles by their rows, then the halves of its quads, cut along the diagonal across
/// which they are less bent. Constraints are barriers. The patch must outlive it; cannot be copied or moved.
class Reference {
 public:
  explicit Reference(const Patch& patch)
      : triangles_(with_halves(patch)),
        surface(patch.points, triangles_.empty() ? patch.triangles : triangles_, patch.constraints) {}
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  /// The triangles of a patch, and the halves of its quads, two and two: the side that they share is the last of the
  /// first and the first of the second. Empty without quads.
  static std::vector<Background::Triangle> with_halves(const Patch& patch);
  /// The halves along the other diagonal of quads that are bent alike along both but for rounding: which of the two is
  /// taken hangs on where a quad begins, and on the axes.
  static std::vector<Background::Triangle> other_halves(const Patch& patch);

 private:
  std::vector<Background::Triangle> triangles_;

 public:
  const Background surface;
};

}  // namespace qmorph::space
