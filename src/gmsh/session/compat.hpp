// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What differs between the Gmsh versions that this code compiles against (4.8 to the newest). Only files
/// of src/gmsh include this, and only they include gmsh.h.

#include <gmsh.h>

#include <cstddef>
#include <string>
#include <vector>

#define QMORPH_GMSH_AT_LEAST(major, minor) \
  (GMSH_API_VERSION_MAJOR > (major) || (GMSH_API_VERSION_MAJOR == (major) && GMSH_API_VERSION_MINOR >= (minor)))

namespace qmorph::adapter {

/// "Plane", "Discrete surface", "Ghost surface", ... (renamed in 4.14).
inline std::string entity_type(int dim, int tag) {
  std::string type;
#if QMORPH_GMSH_AT_LEAST(4, 14)
  ::gmsh::model::getEntityType(dim, tag, type);
#else
  ::gmsh::model::getType(dim, tag, type);
#endif
  return type;
}

/// A node, with parameters on its curve or surface where it has them.
struct PlacedNode {
  std::vector<double> xyz, parameters;
};

inline PlacedNode placed_node(std::size_t tag) {
  PlacedNode node;
#if QMORPH_GMSH_AT_LEAST(4, 9)
  int dim = 0, entity = 0;
  ::gmsh::model::mesh::getNode(tag, node.xyz, node.parameters, dim, entity);
#else
  ::gmsh::model::mesh::getNode(tag, node.xyz, node.parameters);
#endif
  return node;
}

/// Whether a surface has these parameters (u, v) within its boundary. Newer versions take them for coordinates unless
/// they are told; a template, so that only the call which there is has to compile.
template <class Parameters>
bool is_inside(int surface, const Parameters& parameters) {
  if constexpr (requires { ::gmsh::model::isInside(2, surface, parameters, true); })
    return ::gmsh::model::isInside(2, surface, parameters, true) == 1;
  else
    return ::gmsh::model::isInside(2, surface, parameters) == 1;
}

}  // namespace qmorph::adapter

// Elsewhere they would compile with one version of Gmsh only, or mean something else with another.
#pragma GCC poison getType getEntityType getNode isInside
