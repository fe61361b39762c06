// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What a .msh file says about itself, read without Gmsh, which takes what it can get from a file that contradicts
/// itself and complains only sometimes.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace qmorph::adapter {

/// How a .msh file is written. `version` is 0 for other files.
struct MshHeader {
  double version = 0;
  bool binary = false;

  bool is_2() const { return version >= 2 && version < 3; }
  bool is_4() const { return version >= 4 && version < 5; }
};

/// Looks into the first lines of a file. \throws InputError if it is named .msh and is none.
MshHeader read_msh_header(const std::string& path);

/// One line of $PhysicalNames.
struct GroupName {
  int dim = 0, tag = 0;
  std::string name;
};

/// What Gmsh is to be asked for after it has read the file.
struct MshContents {
  std::optional<std::size_t> elements;  ///< how many the file says that it has, where that can be told
  std::vector<GroupName> odd_names;     ///< names with a quote inside, which Gmsh would cut there
};

/// Reads through a file of MSH.
/// \param whole false where a file without elements makes sense: one with data for the mesh of another
/// \throws InputError if it is not complete, or contradicts itself
MshContents check_msh_file(const std::string& path, const MshHeader& header, bool whole = true);

}  // namespace qmorph::adapter
