// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "front/decisions.hpp"
#include "kernel/mesh.hpp"
#include "topology/edits.hpp"

namespace qmorph {

/// The fronts that have been tried on a region: one with other constants need not be tried if it would be the same.
class FrontsMade {
 public:
  bool would_repeat(const FrontOptions& options) const {
    return std::any_of(fronts_.begin(), fronts_.end(),
                       [&](const Front& front) { return front.decisions.would_be_same(options); });
  }

  /// Notes the front, of which `mesh` came, and whether another has made the same elements; where it has put their
  /// nodes makes hardly a difference to what comes of them.
  bool is_repeated(const front::Decisions& decisions, const kernel::Mesh& mesh) {
    const std::uint64_t connectivity = topology::connectivity(mesh);
    const bool is_repeated = std::any_of(fronts_.begin(), fronts_.end(),
                                         [&](const Front& other) { return other.connectivity == connectivity; });
    fronts_.push_back({decisions, connectivity});
    return is_repeated;
  }

 private:
  struct Front {
    front::Decisions decisions;
    std::uint64_t connectivity;  ///< of what it has made
  };
  std::vector<Front> fronts_;
};

}  // namespace qmorph
