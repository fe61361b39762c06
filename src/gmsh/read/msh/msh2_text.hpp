// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Binary files of MSH 2 as text.

#include <string>

namespace qmorph::adapter {

/// Writes a binary file of MSH 2 as ASCII to `text`, number by number.
/// \pre Gmsh is initialised
/// \throws InputError if the file is not complete, or has sections that are not known
void write_msh2_as_text(const std::string& path, const std::string& text);

}  // namespace qmorph::adapter
