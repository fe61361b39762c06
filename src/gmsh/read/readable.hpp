#pragma once
/// Before Gmsh is asked.

#include <string>

namespace qmorph::adapter {

/// \throws InputError if there is no such file, or it is a directory, empty, or not readable.
void check_readable(const std::string& path);

}  // namespace qmorph::adapter
