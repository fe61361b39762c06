// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "qmorph/patch.hpp"
#include "space/background.hpp"

namespace qmorph::space {

/// A patch as background: its triangles by their rows, then the halves of its quads, cut along the diagonal across which they are
/// less bent. Constraints are barriers. The patch must outlive it; cannot be copied or moved.
class Reference {
 public:
  explicit Reference(const Patch& patch)
      : triangles_(with_halves(patch)),
        surface(patch.points, triangles_.empty() ? patch.triangles : triangles_, patch.constraints) {}
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

 private:
  /// Empty without quads.
  static std::vector<Background::Triangle> with_halves(const Patch& patch);
  std::vector<Background::Triangle> triangles_;

 public:
  const Background surface;
};

}  // namespace qmorph::space
