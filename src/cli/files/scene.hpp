// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// From the current Gmsh model to what reports and pictures show.

#include "report/scene.hpp"

namespace qmorph::cli {

/// The model's mesh as it is now: surfaces with their elements, line and point elements, physical groups.
/// \throws InputError if the mesh contradicts itself
report::Scene read_scene();

}  // namespace qmorph::cli
