// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What is reported about a run: the result, what was left, what made no difference.

#include <iosfwd>
#include <string>

#include "cli/request/request.hpp"
#include "gmsh/read/open.hpp"
#include "qmorph/gmsh.hpp"
#include "report/stats.hpp"

namespace qmorph::cli {

/// What messages call it.
std::string name_of_input(const Request& request);

/// What was asked for and makes no difference.
void name_ignored_options(const Request& request, const adapter::OpenedModel& opened, std::ostream& err);

/// \param output what to call it
void print_summary(const Request& request, const adapter::OpenedModel& opened, const ModelReport& model,
                   const report::RunFacts& facts, const std::string& output, std::ostream& err);

}  // namespace qmorph::cli
