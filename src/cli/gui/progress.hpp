// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Keeps the window alive while the library works.

#include <chrono>
#include <string_view>
#include <thread>

#include "gmsh/window/live_window.hpp"
#include "qmorph/options.hpp"

namespace qmorph::cli {

/// For `Options::progress`: handles what the user does, shows how far it is, and stops the work when the button is
/// pressed once more, the window is closed, or the model has become another one meanwhile.
class WindowProgress {
 public:
  explicit WindowProgress(adapter::LiveWindow& window) : window_(window), state_(adapter::loaded_state()) {}
  Progress operator()(std::string_view stage, double share);
  /// It was stopped since somebody changed the model.
  bool model_changed() const { return model_changed_; }

 private:
  using Clock = std::chrono::steady_clock;

  adapter::LiveWindow& window_;
  const adapter::LoadedState state_;
  const std::thread::id main_ = std::this_thread::get_id();
  Clock::time_point next_ = Clock::now();
  Progress answer_ = Progress::go_on;
  bool model_changed_ = false;
};

}  // namespace qmorph::cli
