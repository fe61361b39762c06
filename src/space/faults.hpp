// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

#include "qmorph/check.hpp"
#include "qmorph/patch.hpp"
#include "space/surface_normals.hpp"

namespace qmorph::space {

/// The surface lies back over itself within the element: there the input is folded, or has triangles that are bad
/// themselves, and an element may have no way to be good. That it turns far is no fold.
template <std::size_t N>
bool is_folded_under(const Background& surface, const SurfaceNormals& normals, const Corners<N>& p, Index hint);

/// What is wrong with the geometry of that which a curved surface was made into, if anything: corners that are turned
/// over (not those of the first `kept` quads, nor where the surface itself is folded), nodes beside the surface,
/// handles or holes that come or go. Cost: linear.
/// \param beside how far from the surface a node may be, in sides of an element
std::optional<Defect> find_defect(const Patch& before, const QuadMesh& after, std::size_t kept, double beside);

/// A quad of a curved patch that is turned over among its neighbours or has a corner of 180 degrees or more, or kNone;
/// `corner` gets the node.
Index find_bad_quad(const Patch& patch, Index& corner);

}  // namespace qmorph::space
