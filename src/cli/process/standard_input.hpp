// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A file that comes through the standard input.

#include <iosfwd>
#include <memory>

#include "gmsh/session/scratch_file.hpp"

namespace qmorph::cli {

/// Copies it to a temporary file, whose extension tells Gmsh what it is.
/// \throws InputError if it is empty, no file that can be told by its beginning, or does not end
std::unique_ptr<adapter::ScratchFile> read_standard_input(std::istream& in);

}  // namespace qmorph::cli
