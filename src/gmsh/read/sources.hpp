// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The files that a result depends on.

#include <string>
#include <vector>

#include "gmsh/session/session.hpp"

namespace qmorph::adapter {

/// Files that Gmsh has said it reads. Options of a script that silence it silence this.
std::vector<std::string> files_read(const StageLog& log);

/// These files, and what the scripts among them include, merge or take tables and sizes from, if its name is spelt out
/// there: in the order in which they come up, each once, if they exist.
std::vector<std::string> with_named_files(const std::vector<std::string>& files);

/// A rule for make, in the spelling of compilers: the target depends on the files, and a file that is gone is no
/// mistake.
std::string make_rule(const std::string& target, const std::vector<std::string>& files);

/// True if a script among the files makes a compound of curves or surfaces, which no call of Gmsh tells.
bool name_compounds(const std::vector<std::string>& files);

}  // namespace qmorph::adapter
