// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The physical groups of the current model.

#include <string>
#include <vector>

namespace qmorph::adapter {

struct PhysicalGroup {
  int dim = 0, tag = 0;
  std::string name;
  std::vector<int> entities;
};

/// By dimension, then tag.
std::vector<PhysicalGroup> read_physical_groups();

/// Adds entities to a physical group, which is made if it is not there. It keeps its name if it has one.
void add_to_group(int dim, int group, const std::vector<int>& entities, const std::string& name = {});

}  // namespace qmorph::adapter
