// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/messages/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace qmorph::cli {

std::string progress_line(std::string_view stage, double share, double seconds_so_far) {
  constexpr std::size_t kWidth = 20;
  const double done = std::clamp(share, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(done * kWidth);
  std::string line = fmt::format("  [{}{}] {:3.0f} %  {}", std::string(filled, '#'), std::string(kWidth - filled, ' '),
                                 std::floor(100 * done), stage);
  constexpr double kTooEarly = 0.02;  // to tell from what was done how long the rest will take
  if (done >= kTooEarly) line += fmt::format(", {:.0f} s left", std::ceil(seconds_so_far * (1 - done) / done));
  return line;
}

ProgressBar::~ProgressBar() {
  if (width_ > 0) terminal_ << '\r' << std::string(width_, ' ') << '\r' << std::flush;
}

Progress ProgressBar::operator()(std::string_view stage, double share) {
  const Clock::time_point now = Clock::now();
  if (now < next_) return Progress::go_on;
  next_ = now + std::chrono::milliseconds(250);
  const std::string line = progress_line(stage, share, std::chrono::duration<double>(now - start_).count());
  width_ = std::max(width_, line.size());
  // Back to the start of the line at once: whatever comes next writes over it.
  terminal_ << line << std::string(width_ - line.size(), ' ') << '\r' << std::flush;
  return Progress::go_on;
}

}  // namespace qmorph::cli
