// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Which options go together.

#include <span>
#include <string_view>

#include "cli/request/request.hpp"

namespace qmorph::cli {

/// \param given the options on the command line ("-o", "--layers"), also those whose value is the default
/// \throws UsageError for options that contradict each other, or that would have no effect
void check_combination(const Request& request, std::span<const std::string_view> given);

}  // namespace qmorph::cli
