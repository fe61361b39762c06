// SPDX-License-Identifier: GPL-2.0-or-later
#include "parallel/shared_progress.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <utility>

#include "qmorph/error.hpp"

namespace qmorph::parallel {

struct SharedProgress::State {
  ProgressCallback report;
  double total;
  double done = 0;
  Progress answer = Progress::go_on;
  std::exception_ptr thrown;
  std::mutex mutex;

  State(ProgressCallback callback, double sum) : report(std::move(callback)), total(sum) {}

  Progress ask(std::string_view stage) {
    if (thrown) std::rethrow_exception(thrown);
    if (answer == Progress::cancel) return answer;
    try {
      return answer = report(stage, std::min(1.0, done / total));
    } catch (...) {
      thrown = std::current_exception();
      throw;
    }
  }
};

SharedProgress::SharedProgress(ProgressCallback report, double total) {
  if (report && total > 0) state_ = std::make_shared<State>(std::move(report), total);
}

ProgressCallback SharedProgress::part(double weight) const {
  if (!state_) return {};
  return [state = state_, weight, before = 0.0](std::string_view stage, double share) mutable {
    const std::lock_guard lock(state->mutex);
    if (share > before) state->done += weight * (share - before), before = share;
    return state->ask(stage);
  };
}

bool SharedProgress::is_over() const {
  if (!state_) return false;
  const std::lock_guard lock(state_->mutex);
  return state_->thrown || state_->answer == Progress::cancel;
}

void SharedProgress::finish() const {
  if (!state_) return;
  if (state_->thrown) std::rethrow_exception(state_->thrown);
  if (state_->answer == Progress::cancel) throw Cancelled();
}

}  // namespace qmorph::parallel
