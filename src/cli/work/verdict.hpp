// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// --check: a verdict on a mesh that is there.

#include <string>
#include <vector>

#include "cli/request/request.hpp"
#include "qmorph/gmsh.hpp"

namespace qmorph::cli {

/// What is wrong with a measured mesh, one line for each reason; empty if nothing is.
std::vector<std::string> find_reasons(const ModelReport& model, const Thresholds& thresholds);

}  // namespace qmorph::cli
