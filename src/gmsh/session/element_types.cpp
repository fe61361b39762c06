// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/session/element_types.hpp"

#include <string>

#include "gmsh/session/compat.hpp"

namespace qmorph::adapter {

ElementType element_type(int type) {
  ElementType result;
  result.type = type;
  std::string name;
  int nodes = 0, corners = 0;
  std::vector<double> local;
  ::gmsh::model::mesh::getElementProperties(type, name, result.dim, result.order, nodes, local, corners);
  result.nodes = static_cast<std::size_t>(nodes);
  result.corners = static_cast<std::size_t>(corners);
  if (result.dim != 2 || result.nodes == 0) return result;
  const std::size_t stride = local.size() / result.nodes;  // 2 or 3, by Gmsh's version
  for (std::size_t i = 0; i < result.nodes; ++i)
    result.local.insert(result.local.end(), {local[i * stride], local[i * stride + 1]});
  return result;
}

int type_number(std::size_t corners, int order, bool incomplete) {
  return ::gmsh::model::mesh::getElementType(corners == 3 ? "Triangle" : "Quadrangle", order, incomplete);
}

bool has_elements(int dim, int tag) {
  std::vector<int> types;
  ::gmsh::model::mesh::getElementTypes(types, dim, tag);
  return !types.empty();
}

}  // namespace qmorph::adapter
