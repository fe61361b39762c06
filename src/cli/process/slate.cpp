// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/process/slate.hpp"

#include <algorithm>

namespace qmorph::cli {

void Slate::begin(ExitStatus status, std::string_view trouble) {
  const std::size_t length = std::min(trouble.size(), trouble_.size() - 1);
  std::copy_n(trouble.begin(), length, trouble_.begin());
  trouble_[length] = '\0';
  status_ = status;
}

}  // namespace qmorph::cli
