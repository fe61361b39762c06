// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Surfaces that are images of one another. The image of a converted surface is its copy, so that the pair stays a
/// pair.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "gmsh/convert/replace.hpp"
#include "gmsh/model/model_mesh.hpp"
#include "gmsh/model/patches.hpp"
#include "gmsh/model/periodic_links.hpp"

namespace qmorph::adapter {

/// Surfaces that are periodic with one another, directly or not.
struct PeriodicFamily {
  std::vector<int> members;               ///< tags; a master comes before its slaves
  std::vector<const PeriodicLink*> link;  ///< of each member to its master; null for the first
  /// Where the master of a member stands.
  std::size_t master_of(std::size_t member) const;
};
std::vector<PeriodicFamily> find_families(const std::vector<PeriodicLink>& links);

/// Brings the parts of the slave into the master's order and takes over to the master what the slave wants to keep.
/// \throws SurfaceError if the slave's mesh is not the image of the master's
void match_parts(const PeriodicLink& link, const ModelMesh& mesh, SurfaceMesh& master, SurfaceMesh& slave);

/// The master's result, moved to the slave. \pre match_parts
std::vector<QuadMesh> copy_results(const PeriodicLink& link, const ConvertedSurface& master, const SurfaceMesh& slave,
                                   const ModelMesh& mesh);

/// Restores the links of a model whose surfaces have been replaced: pairs of new nodes where both surfaces were
/// converted, the old ones where a surface had to be put back as it was.
/// \param mesh the model before \param part_tags of replace_surfaces()
void restore_periodicity(const ModelMesh& mesh, const std::vector<ConvertedSurface>& converted,
                         const std::vector<PartTags>& part_tags, std::vector<PeriodicLink>& links);

}  // namespace qmorph::adapter
