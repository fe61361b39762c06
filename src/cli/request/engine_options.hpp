// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "cli/request/request.hpp"
#include "qmorph/options.hpp"

namespace qmorph::cli {

/// The engine's options for the request. \throws UsageError for unknown names and values
Options engine_options(const Request& request);

}  // namespace qmorph::cli
