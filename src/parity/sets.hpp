// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "qmorph/export.hpp"
#include "qmorph/index.hpp"

namespace qmorph::parity {

/// Sets that grow together; the smallest member stands for all.
class QMORPH_API Sets {
 public:
  explicit Sets(std::size_t count);
  Index root(Index i);
  void unite(Index i, Index j);
  std::vector<std::vector<Index>> members();  ///< by root; empty for other members

 private:
  std::vector<Index> parent_;
};

}  // namespace qmorph::parity
