// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What Gmsh knows of entities that are images of one another.

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "gmsh/model/model_mesh.hpp"

namespace qmorph::adapter {

/// One surface (the slave), or curve or point, that is the image of another.
struct PeriodicLink {
  int dim = 2;
  int slave = 0, master = 0;                               ///< tags
  std::vector<double> transformation;                      ///< 4 x 4 by rows, from the master to the slave
  std::vector<std::pair<std::size_t, std::size_t>> nodes;  ///< tags: slave's, master's
  bool is_extrusion = false;                               ///< of find_extrusions(): Gmsh does not know of it
};

/// Links between entities of one dimension of the current model, by the slave's tag.
std::vector<PeriodicLink> read_periodic_links(const ModelMesh& mesh, int dim = 2);

/// Where the transformation of a link takes a point.
Eigen::Vector3d transformed(const std::vector<double>& transformation, const Eigen::Vector3d& p);

/// Adds the nodes between the corners to a link that has the corners.
/// \param mesh the model's, with the surfaces' new elements
void add_high_order_pairs(const ModelMesh& mesh, PeriodicLink& link);

/// Tells Gmsh which nodes belong together: it forgets them with the nodes of a surface.
/// \throws InputError
void restore_links(const std::vector<PeriodicLink>& links);

}  // namespace qmorph::adapter
