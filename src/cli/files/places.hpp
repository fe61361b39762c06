// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Where everything is to be written, and what for.

#include <string>

#include "cli/request/request.hpp"
#include "gmsh/write/write.hpp"

namespace qmorph::cli {

/// Also by different names, through links, and before there is such a file.
bool is_same_file(const std::string& a, const std::string& b);

/// Refuses what would fail in the end, before hours are spent on a mesh. \throws UsageError, InputError, OutputError
adapter::OutputPlan check_places(const Request& request);

}  // namespace qmorph::cli
