// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace qmorph::cli {

/// Part of the command's contract: scripts depend on these numbers.
enum ExitStatus : int {
  all_converted = 0,
  bad_usage = 1,
  bad_input = 2,
  converted_in_part = 3,
  no_surface = 4,
  cannot_write = 5,
  not_good_enough = 6,
};

}  // namespace qmorph::cli
