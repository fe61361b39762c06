// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What Gmsh's writers get wrong, mended in the file that they wrote.

#include <string>

#include "gmsh/write/formats.hpp"

namespace qmorph::adapter {

/// \param written path of a file in a format other than MSH
/// \param target the name that it will have
/// \param order of its surface elements
void amend(const std::string& written, const std::string& target, const OutputFormat& format, int order);

/// Gmsh does not notice when the disk is full. \throws OutputError if a .msh file does not end as a complete one does
void check_msh_end(const std::string& written, const std::string& target);

}  // namespace qmorph::adapter
