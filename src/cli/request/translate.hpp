// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Both spellings of options become one.

#include <string>
#include <vector>

#include "cli/request/request.hpp"

namespace qmorph::cli {

/// Takes out what is Gmsh's, into `request`, and gives the rest CLI11's spelling. \throws UsageError
std::vector<std::string> translate(const std::vector<std::string>& arguments, Request& request);

/// What CLI11 says, with the names as --help shows them.
std::string with_our_spelling(std::string message);

}  // namespace qmorph::cli
