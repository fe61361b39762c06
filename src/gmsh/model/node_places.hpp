// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Where the nodes are. Whenever a file is read, newer versions of Gmsh move the nodes of what is periodic to the image
/// of their masters, and the boundary of a surface is not ours, nor Gmsh's, to move.

#include <cstddef>
#include <vector>

namespace qmorph::adapter {

/// Places of all nodes of the current model.
class NodePlaces {
 public:
  NodePlaces();
  /// Puts those nodes of the current model that are here by their tags to these places.
  void restore() const;

 private:
  std::vector<std::size_t> tags_;
  std::vector<double> xyz_;
};

}  // namespace qmorph::adapter
