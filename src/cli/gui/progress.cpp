// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/gui/progress.hpp"

#include <fmt/format.h>

#include "cli/gui/panel.hpp"

namespace qmorph::cli {
namespace {

constexpr std::chrono::milliseconds kBetween{100};

}  // namespace

Progress WindowProgress::operator()(std::string_view stage, double share) {
  // Only the main thread may talk to the window; it takes part in the work like the others.
  if (answer_ == Progress::cancel || std::this_thread::get_id() != main_ || Clock::now() < next_) return answer_;
  window_.status(fmt::format("{}: {:.0f} %", stage, 100 * share));
  window_.turn(0);
  model_changed_ = adapter::loaded_state() != state_;
  if (model_changed_ || !window_.is_open() || adapter::take_action() == action::kCancel) answer_ = Progress::cancel;
  next_ = Clock::now() + kBetween;
  return answer_;
}

}  // namespace qmorph::cli
