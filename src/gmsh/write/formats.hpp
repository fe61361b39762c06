// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The mesh formats that Gmsh writes, and what each of them can hold.

#include <string>

namespace qmorph::adapter {

/// A file format of Gmsh's `-format` option.
struct OutputFormat {
  std::string name;
  std::string extension;   ///< with the dot; Gmsh's API chooses the format by it
  double msh_version = 0;  ///< 0 if it is not MSH, or MSH in whatever version fits
  bool is_msh = false;
  int max_order = 1;   ///< of elements that the format's readers know
  int quad_nodes = 0;  ///< of quads of order 2; 0: either 8 or 9
};

/// \throws UsageError for a name that Gmsh's -format does not have; OutputError if the format cannot hold quads
OutputFormat format_by_name(const std::string& name);

/// \throws OutputError for an extension that Gmsh does not have, or if the format cannot hold quads
OutputFormat format_by_extension(const std::string& path);

/// With the dot. All versions of MSH share one unless the user writes another.
std::string default_extension(const OutputFormat& format);

}  // namespace qmorph::adapter
