// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The mesh of the current model as it is now, to go back to.

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

/// The model gets the mesh that it had then, in the same order, whatever mesh it has now. \pre its entities are those
/// that it had then. \throws InputError if Gmsh refuses a step
void restore(const Snapshot& snapshot);

/// The model without any node or element.
void clear_mesh();

}  // namespace qmorph::adapter
