// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/messages/progress.hpp"

#include <doctest/doctest.h>

#include <sstream>

using namespace qmorph::cli;

TEST_CASE("progress: the line has a bar, the share, the stage and the time left at this pace") {
  CHECK(progress_line("front", 0.25, 3) == "  [#####               ]  25 %  front, 9 s left");
  CHECK(progress_line("smoothing", 1, 3) == "  [####################] 100 %  smoothing, 0 s left");
  CHECK(progress_line("cleanup", 0.999, 100) == "  [################### ]  99 %  cleanup, 1 s left");
}

TEST_CASE("progress: no time is predicted from next to nothing, and shares out of range do no harm") {
  CHECK(progress_line("front", 0.001, 1) == "  [                    ]   0 %  front");
  CHECK(progress_line("front", -1, 1) == "  [                    ]   0 %  front");
  CHECK(progress_line("front", 7, 1) == "  [####################] 100 %  front, 0 s left");
}

TEST_CASE("progress: a run of less than a second leaves no trace on the terminal") {
  std::ostringstream terminal;
  {
    ProgressBar progress(terminal);
    for (int i = 0; i < 10; ++i) progress("front", 0.1 * i);
  }
  CHECK(terminal.str().empty());
}
