// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Gmsh's own quads beside ours.

#include <string>

#include "gmsh/window/shown_views.hpp"
#include "gmsh/window/snapshot.hpp"
#include "report/picture.hpp"

namespace qmorph::cli {

/// Lets Gmsh recombine the same triangles in a model of its own, to the right of the current one, which stays the
/// current one. Views of it are added to `views`. \return its figures in a line
std::string compare_with_gmsh(const adapter::Snapshot& triangles, report::PictureColour colour, bool irregular,
                              adapter::ShownViews& views);

}  // namespace qmorph::cli
