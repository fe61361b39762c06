// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Which options go together.

#include <functional>
#include <string>

#include "cli/request/request.hpp"

namespace qmorph::cli {

/// \param given whether an option is on the command line, also where its value is the default
/// \throws UsageError for options that contradict each other, or that would have no effect
void check_combination(const Request& request, const std::function<bool(const std::string& option)>& given);

}  // namespace qmorph::cli
