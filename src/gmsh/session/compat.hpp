#pragma once
/// What differs between the Gmsh versions that this code compiles against (4.8 to the newest). Only files
/// of src/gmsh include this, and only they include gmsh.h.

#include <gmsh.h>

#include <string>

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

}  // namespace qmorph::adapter
