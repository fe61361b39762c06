#pragma once
/// One bar for several parts that are worked on side by side.

#include <functional>
#include <memory>
#include <string_view>

namespace qmorph::parallel {

using Progress = std::function<void(std::string_view stage, double share)>;

/// Calls `report`, one call at a time, with the share that all parts together have done. It never falls.
class SharedProgress {
 public:
  /// `report` may be empty, and is called as long as one of the parts is. `total` is the sum of all weights.
  SharedProgress(Progress report, double total);
  /// For one part of this weight; empty if `report` is.
  Progress part(double weight) const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace qmorph::parallel
