// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A copy of the current model's mesh, to go back to.

#include <vector>

#include "gmsh/model/model_mesh.hpp"
#include "gmsh/model/periodic_links.hpp"

namespace qmorph::adapter {

/// A copy of the whole mesh, with what tells which entities are images of one another.
struct Snapshot {
  ModelMesh mesh;
  std::vector<PeriodicLink> links;  ///< of points, curves and surfaces
};

/// \throws InputError as read_model_mesh() does
Snapshot take_snapshot();

/// Gives the model the mesh that it had then, in the same order, whatever mesh it has now. \pre the model has the same
/// entities as then. \throws InputError if Gmsh refuses a step
void restore(const Snapshot& snapshot);

/// Removes all nodes and elements from the model.
void clear_mesh();

}  // namespace qmorph::adapter
