// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/volumes/volumes.hpp"

#include "gmsh/session/compat.hpp"
#include "gmsh/session/element_types.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {

bool drop_volumes() {
  ::gmsh::vectorpair volumes;
  ::gmsh::model::getEntities(volumes, 3);
  std::vector<int> types;
  ::gmsh::model::mesh::getElementTypes(types, 3);
  if (types.empty()) return false;
  const StageLog log = run_logged([&] { ::gmsh::model::mesh::clear(volumes); });
  ::gmsh::model::mesh::getElementTypes(types, 3);
  if (!log.errors.empty() || !types.empty())
    throw InputError("Gmsh cannot remove the volume elements: " + first_errors(log));
  return true;
}

VolumeCounts count_volume_elements() {
  VolumeCounts counts;
  ::gmsh::vectorpair volumes;
  ::gmsh::model::getEntities(volumes, 3);
  for (const auto& [dim, tag] : volumes) {
    std::vector<int> types;
    ::gmsh::model::mesh::getElementTypes(types, 3, tag);
    if (!types.empty()) ++counts.volumes;
    for (const int type : types) {
      std::vector<std::size_t> tags, nodes;
      ::gmsh::model::mesh::getElementsByType(type, tags, nodes, tag);
      const std::size_t corners = element_type(type).corners;
      (corners == 8   ? counts.hexahedra
       : corners == 6 ? counts.prisms
       : corners == 5 ? counts.pyramids
                      : counts.tetrahedra) += tags.size();
    }
  }
  return counts;
}

}  // namespace qmorph::adapter
