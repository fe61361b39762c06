// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A second opinion on what the engine has made, against the input and in space: for those who must know before they
/// use it.

#include <Eigen/Core>
#include <optional>
#include <string>

#include "qmorph/export.hpp"
#include "qmorph/patch.hpp"

namespace qmorph {

/// What is wrong, and where.
struct Defect {
  std::string what;  ///< in words, with the place: "a fixed node has moved at (1, 2, 0)"
  std::optional<Eigen::Vector3d> place;
};

/// Whether the quads of the input have to be in the result: convert() keeps them, improve() does not.
enum class InputQuads { kept, free };

/// What is wrong with the quads that were made of a patch: a boundary or constraint edge that is gone, a fixed node
/// that has moved, elements that do not fit together, overlap, or have a corner that is not convex, a change of area;
/// on a curved surface corners that are turned over (see QualityAccumulator), except where the surface itself is
/// folded, nodes that lie off it, and holes or handles that appear or vanish. Elements of the input that were free to
/// change and are bad themselves make no fold; what is made there is judged by the elements around it. Empty if nothing
/// is wrong. Cost: linear.
/// \param beside how far from the triangles of a curved patch a node may be, in sides of an element
QMORPH_API std::optional<Defect> find_defect(const Patch& patch, const QuadMesh& mesh,
                                             InputQuads quads = InputQuads::kept, double beside = 1e-6);

/// A quad that is inverted, or has a corner of 180 degrees or more.
struct BadQuad {
  Index quad = kNone;  ///< row of `Patch::quads`
  Eigen::Vector3d place;
};

/// The first of the patch's own quads that is bad, if there is one.
QMORPH_API std::optional<BadQuad> find_bad_quad(const Patch& patch);

/// Whether all nodes of a patch lie in one plane.
QMORPH_API bool is_planar(const Patch& patch);

/// Unit normal that the elements of a planar patch follow: the direction of the sum of their area vectors.
QMORPH_API Eigen::Vector3d mean_normal(const Patch& patch);

}  // namespace qmorph
