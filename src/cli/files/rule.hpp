// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// --depfile.

#include <string>

#include "cli/request/request.hpp"
#include "gmsh/read/open.hpp"
#include "gmsh/write/write.hpp"

namespace qmorph::cli {

/// What the result depends on: what Gmsh has read, and what it was told to read.
std::string rule_for_make(const Request& request, const adapter::OpenedModel& opened, const adapter::OutputPlan& plan);

}  // namespace qmorph::cli
