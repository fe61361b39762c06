#pragma once
/// MSH 2.2, written by ourselves.

#include <string>

namespace qmorph::adapter {

/// Writes the current model as MSH 2.2 with the tags of its nodes and elements. Gmsh's own writer numbers both anew
/// in an order that depends on the physical groups, so that points and curves that came from a file would
/// come out with other tags.
/// \pre no entity is in more than one physical group (version 2 stores one for each element), and there are no
/// partitions
/// \throws OutputError
void write_msh2(const std::string& path, bool binary);

}  // namespace qmorph::adapter
