// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "cli/request/request.hpp"
#include "qmorph/options.hpp"

namespace qmorph::cli {

/// What the request says to the engine. \throws UsageError for names and values that there are not
Options engine_options(const Request& request);

}  // namespace qmorph::cli
