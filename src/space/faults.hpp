// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "qmorph/check.hpp"
#include "qmorph/patch.hpp"
#include "space/result.hpp"
#include "space/surface_normals.hpp"

namespace qmorph::space {

/// The surface lies back over itself within the element: there the input is folded, or has triangles that are bad
/// themselves, and an element may have no way to be good. That it turns far is no fold. `unsure`, by triangle, are
/// those that make no fold, as unsure_ground() has them; may be empty.
template <std::size_t N>
bool is_folded_under(const Background& surface, const SurfaceNormals& normals, const Corners<N>& p, Index hint,
                     std::span<const char> unsure = {});

/// By element of a curved patch, triangles first: whether it is turned over among its neighbours, crosses itself, or is
/// folded along its diagonal.
std::vector<char> bad_elements(const Patch& patch);

/// By triangle of Reference::with_halves(patch): whether it is, or is half of, one of bad_elements(). Where elements
/// are free to change that is a fault of the mesh, and no fold of the surface that it stands for. Empty if none is.
std::vector<char> unsure_ground(const Patch& patch);

/// Whether such triangles are part of what says which way is up for an element of a result.
template <std::size_t N>
bool is_on_unsure_ground(const Result& result, Index element, const Corners<N>& p, std::span<const char> unsure);

/// An element of a result that may be turned over.
struct Suspect {
  Index element;
  bool has_bad_corner;  ///< else it lies back over a neighbour, as it may where the surface does
};

/// Elements that are turned over among their neighbours or lie back over one, but for the first `kept` quads.
std::vector<Suspect> find_suspects(const Patch& before, const QuadMesh& after, std::size_t kept);

/// One of the suspects, where the patch itself is not folded: the surface's normals cannot tell where the patch has
/// such elements itself. Where the `kept` quads are all that the patch has, only over triangles that are turned over
/// themselves.
std::optional<Defect> find_turned(const Patch& before, const QuadMesh& after, std::size_t kept,
                                  std::vector<Suspect> suspects);

/// What is wrong with the geometry of that which a curved surface was made into, if anything: corners that are turned
/// over (not those of the first `kept` quads, nor where the surface itself is folded), nodes beside the surface,
/// handles or holes that come or go. Cost: linear.
/// \param beside how far from the surface a node may be, in sides of an element or of the triangle under it
std::optional<Defect> find_defect(const Patch& before, const Result& result, std::size_t kept, double beside);

/// A quad of a curved patch that is turned over among its neighbours or has a corner of 180 degrees or more, or kNone;
/// `corner` gets the node.
Index find_bad_quad(const Patch& patch, Index& corner);

}  // namespace qmorph::space
