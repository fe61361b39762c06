// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A line on a terminal that shows the progress.

#include <chrono>
#include <ostream>
#include <string>
#include <string_view>

#include "qmorph/options.hpp"

namespace qmorph::cli {

/// "  [#######             ]  35 %  cleanup, 12 s left". Without the time while nothing is done yet.
std::string progress_line(std::string_view stage, double share, double seconds_so_far);

/// For `Options::progress`. Quiet in the first second: most runs are over by then. Wipes its line when it goes.
class ProgressBar {
 public:
  explicit ProgressBar(std::ostream& terminal) : terminal_(terminal) {}
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  Progress operator()(std::string_view stage, double share);

 private:
  using Clock = std::chrono::steady_clock;

  std::ostream& terminal_;
  Clock::time_point start_ = Clock::now(), next_ = start_ + std::chrono::seconds(1);
  std::size_t width_ = 0;  ///< of what stands on the line
};

}  // namespace qmorph::cli
