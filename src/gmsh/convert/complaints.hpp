// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What is wrong with a model or a surface, in words for its user.

#include <string>
#include <vector>

#include "gmsh/convert/classified.hpp"
#include "gmsh/model/patches.hpp"
#include "qmorph/report.hpp"

namespace qmorph::adapter {

/// Quads of the input stay as they are, and what comes out must not have an inverted element. \throws SurfaceError
void refuse_bad_quads(const SurfaceMesh& surface);

/// A quad may cross itself because a node has been pulled through it, which can be mended. Where it does so with two
/// sides that no other element has, which have to stay, it cannot. \throws SurfaceError
void refuse_crossed_quads(const SurfaceMesh& surface);

/// Coincident nodes that are not joined, and surfaces that lie on each other: such a mesh looks right, but it falls
/// apart, or covers the same place twice.
void warn_of_loose_parts(const ClassifiedMesh& model, std::vector<std::string>& warnings);

/// If quads are much longer or shorter than the triangles were; empty if not.
std::string describe_lost_size(const std::vector<DirectedSize>& sizes);

}  // namespace qmorph::adapter
