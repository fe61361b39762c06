#include "gmsh/groups.hpp"

#include <algorithm>

#include "gmsh/compat.hpp"

namespace qmorph::adapter {

std::vector<PhysicalGroup> read_physical_groups() {
  ::gmsh::vectorpair tags;
  ::gmsh::model::getPhysicalGroups(tags);
  std::sort(tags.begin(), tags.end());
  std::vector<PhysicalGroup> groups;
  for (const auto& [dim, tag] : tags) {
    PhysicalGroup group{dim, tag, {}, {}};
    ::gmsh::model::getPhysicalName(dim, tag, group.name);
    ::gmsh::model::getEntitiesForPhysicalGroup(dim, tag, group.entities);
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace qmorph::adapter
