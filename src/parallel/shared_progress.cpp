#include "parallel/shared_progress.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

namespace qmorph::parallel {

struct SharedProgress::State {
  Progress report;
  double total;
  double done = 0;
  std::mutex mutex;

  State(Progress callback, double sum) : report(std::move(callback)), total(sum) {}
};

SharedProgress::SharedProgress(Progress report, double total) {
  if (report && total > 0) state_ = std::make_shared<State>(std::move(report), total);
}

Progress SharedProgress::part(double weight) const {
  if (!state_) return {};
  return [state = state_, weight, before = 0.0](std::string_view stage, double share) mutable {
    const std::lock_guard lock(state->mutex);
    if (share > before) state->done += weight * (share - before), before = share;
    state->report(stage, std::min(1.0, state->done / state->total));
  };
}

}  // namespace qmorph::parallel
