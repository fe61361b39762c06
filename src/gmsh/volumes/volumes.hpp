// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Volumes of the current model: removed, made on the quads, counted.

#include <cstddef>
#include <string>
#include <vector>

namespace qmorph::adapter {

/// Removes the elements of all volumes, so that their surfaces may become quads. \return true if there were any
bool drop_volumes();

/// Elements of dimension 3, of any order.
struct VolumeCounts {
  std::size_t volumes = 0;  ///< that have elements
  std::size_t hexahedra = 0, prisms = 0, pyramids = 0, tetrahedra = 0;
};
VolumeCounts count_volume_elements();

struct MeshedVolumes {
  std::vector<std::string> warnings;  ///< Gmsh's
  std::vector<std::string> told;      ///< what differs from what was asked for
  std::vector<std::string> bad;       ///< volumes with elements that are turned over or do not fit, and where
};

/// Meshes the volumes of the current model on its surfaces as they are: hexahedra and prisms where a surface is
/// extruded, else pyramids on quads, then tetrahedra. Volumes that share quads are meshed one after the other, and
/// nodes inside are moved where Gmsh has left an element turned over. Volumes without a geometry, too, where the model
/// says what surfaces they have. Gmsh 4.8 makes pyramids in one session of a process only: after a finalize() and a
/// second initialize() it crashes.
/// \param keep_numbers of nodes and elements that are there
/// \throws InputError; BrokenModel, after which Gmsh must not be ended
MeshedVolumes mesh_volumes(bool keep_numbers);

}  // namespace qmorph::adapter
