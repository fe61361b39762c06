// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One bar for several parts that are worked on side by side.

#include <memory>

#include "qmorph/options.hpp"

namespace qmorph::parallel {

/// Calls `report`, one call at a time, with the share that all parts together have done. It never falls. When one part
/// is told to stop, so are all others; what one call has thrown, the others throw.
class SharedProgress {
 public:
  /// `report` may be empty, and is called as long as one of the parts is. `total` is the sum of all weights.
  SharedProgress(ProgressCallback report, double total);
  /// For one part of this weight; empty if `report` is.
  ProgressCallback part(double weight) const;

  /// Parts that have not begun need not begin any more.
  bool is_over() const;
  /// Throws what the end of all parts is to throw: what `report` has thrown, or Cancelled.
  void finish() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace qmorph::parallel
