// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <chrono>
#include <utility>

namespace qmorph::adapter {

/// Seconds since it was made, or since it was last asked.
class StopWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace qmorph::adapter
