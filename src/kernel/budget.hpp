// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <limits>

#include "kernel/mesh.hpp"

namespace qmorph::kernel {

/// How much an improvement may cost: work on a mesh (`Mesh::work()`), never time, so that it ends at the same place on
/// every machine. What makes a mesh better looks at it before each try; what makes a mesh valid does not.
class Budget {
 public:
  /// Without a bound.
  Budget() = default;
  /// `work` from now on.
  Budget(const Mesh& mesh, std::size_t work) : mesh_(&mesh), most_(mesh.work() + work) {}
  std::size_t left() const { return !mesh_ ? most_ : most_ - std::min(most_, mesh_->work()); }
  bool is_spent() const { return left() == 0; }
  /// Whether so many tries of this cost each would spend it: then it matters which come first.
  bool is_short_for(std::size_t tries, std::size_t cost) const { return tries > left() / cost; }

 private:
  const Mesh* mesh_ = nullptr;
  std::size_t most_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace qmorph::kernel
