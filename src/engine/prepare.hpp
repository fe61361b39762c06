// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "kernel/mesh.hpp"
#include "qmorph/error.hpp"

namespace qmorph {

struct Plane;

/// Makes the triangles of a region fit to start from: zero-area triangles are turned away by a swap of their longest
/// side, nested ones from the good triangle inwards, or by moving a free corner. Throws SurfaceError where that is
/// impossible, or where a triangle is turned over, which means that triangles overlap. `node`: row of Patch::points of
/// each vertex, for errors.
void repair_input(kernel::Mesh& mesh, const std::vector<Index>& node, const Plane& plane);

/// A complaint, if a large share of the triangles is thinner than an element may be (`kStraightSine`). A few of these
/// can be turned into better ones, and rectangles may be as thin as they like, but a front has no room there.
std::optional<SurfaceError> find_needles(const kernel::Mesh& mesh, const Plane& plane);

/// "(x, y, z), (x, y, z), ...", the corners of a face, for messages.
std::string corners_of(const kernel::Mesh& mesh, const Plane& plane, Index f);

/// The first corner of a face, for errors.
Eigen::Vector3d corner_of(const kernel::Mesh& mesh, const Plane& plane, Index f);

}  // namespace qmorph
