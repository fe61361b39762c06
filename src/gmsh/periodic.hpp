#pragma once
/// Surfaces that are images of one another. The image of a converted surface is its copy, so that the pair stays a pair.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "gmsh/model_mesh.hpp"
#include "gmsh/patches.hpp"
#include "gmsh/replace.hpp"

namespace qmorph::adapter {

/// One surface (the slave), or curve or point, that is the image of another.
struct PeriodicLink {
  int dim = 2;
  int slave = 0, master = 0;                               ///< tags
  std::vector<double> transformation;                      ///< 4 x 4 by rows, from the master to the slave
  std::vector<std::pair<std::size_t, std::size_t>> nodes;  ///< tags: slave's, master's
};

/// Links between entities of one dimension of the current model, by the slave's tag.
std::vector<PeriodicLink> read_periodic_links(const ModelMesh& mesh, int dim = 2);

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

/// Adds the nodes between the corners to a link that has the corners.
/// \param mesh the model's, with the surfaces' new elements
void add_high_order_pairs(const ModelMesh& mesh, PeriodicLink& link);

/// Tells Gmsh which nodes belong together: it forgets them with the nodes of a surface.
/// \throws InputError
void restore_links(const std::vector<PeriodicLink>& links);

}  // namespace qmorph::adapter
