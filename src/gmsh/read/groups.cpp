// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/groups.hpp"

#include <algorithm>
#include <utility>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "kernel/sort_unique.hpp"

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

/// Groups cannot be added to: they are made anew.
void add_to_group(int dim, int group, const std::vector<int>& entities, const std::string& name) {
  std::vector<int> all;
  std::string kept;
  ::gmsh::model::getPhysicalName(dim, group, kept);  // which goes with the group
  ::gmsh::vectorpair known;
  ::gmsh::model::getPhysicalGroups(known, dim);
  if (std::count(known.begin(), known.end(), std::pair(dim, group))) {
    ::gmsh::model::getEntitiesForPhysicalGroup(dim, group, all);
    // It complains that the built-in kernel does not have the group, and removes it.
    run_logged([&] { ::gmsh::model::removePhysicalGroups({{dim, group}}); });
  }
  all.insert(all.end(), entities.begin(), entities.end());
  sort_unique(all);
  ::gmsh::model::addPhysicalGroup(dim, all, group);
  if (kept.empty()) kept = name;
  if (!kept.empty()) ::gmsh::model::setPhysicalName(dim, group, kept);
}

}  // namespace qmorph::adapter
