#pragma once
/// A line on a terminal that says how far it is.

#include <chrono>
#include <ostream>
#include <string_view>

namespace qmorph::cli {

/// For `Options::progress`. Quiet in the first second: most runs are over by then.
class Progress {
 public:
  explicit Progress(std::ostream& terminal) : terminal_(&terminal) {}

  void operator()(std::string_view stage, double share) {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(250);
    // Back to the start of the line at once: whatever comes next writes over it.
    *terminal_ << "  " << stage << ' ' << static_cast<int>(100 * share) << " %    \r" << std::flush;
  }

 private:
  std::ostream* terminal_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + std::chrono::seconds(1);
};

}  // namespace qmorph::cli
