// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The edge lengths that a mesh had when cleanup began, so that many small changes do not drift away from them.

#include <vector>

#include "kernel/mesh.hpp"

namespace qmorph::cleanup {

class ElementSize {
 public:
  explicit ElementSize(const kernel::Mesh& mesh);

  /// How many quads of the wanted size have the area of these quads.
  double quads_wanted(const std::vector<Index>& quads) const;
  /// Sizes of the nodes differ by no more than this factor, the largest and smallest few aside.
  bool is_uniform(double factor) const;
  double mean(const std::vector<Index>& nodes) const;
  /// For new nodes: the size of those that they replace.
  void set(Index v, double size);

 private:
  const kernel::Mesh& mesh_;
  std::vector<double> size_;  ///< by node
};

}  // namespace qmorph::cleanup
