// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cli/request/gmsh_options.hpp"
#include "cli/request/request.hpp"

namespace qmorph::cli {

/// Notes an option of Gmsh's in the request: for Gmsh, and what of it matters to us. \throws UsageError
void take_gmsh_option(const GmshOptionRow& row, const std::vector<std::string>& values, Request& request);

}  // namespace qmorph::cli
