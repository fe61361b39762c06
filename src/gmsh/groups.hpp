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

}  // namespace qmorph::adapter
