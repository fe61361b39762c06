// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/prepare.hpp"

#include "engine/overlap.hpp"
#include "engine/regions.hpp"
#include "geometry/predicates.hpp"
#include "qmorph/error.hpp"
#include "smoothing/smooth.hpp"
#include "topology/edits.hpp"

namespace qmorph {
namespace {

using kernel::Mesh;

Index longest_side(const Mesh& mesh, Index f) {
  Index h = mesh.half_edge(f), longest = h;
  for (int i = 0; i < 3; ++i, h = mesh.next(h))
    if (mesh.length(h) > mesh.length(longest)) longest = h;
  return longest;
}

/// The middle node of a flat triangle is joined to the node across its longest side instead.
bool swap_away(Mesh& mesh, Index f) {
  const Index h = longest_side(mesh, f);
  if (!mesh.can_flip(h)) return false;
  mesh.flip(h);
  return true;
}

/// Flat triangles are often nested: across the longest side of one lies the next, and so on to a good triangle. From
/// `f` to the last flat one. The longest sides get longer, so that it ends.
std::vector<Index> chain_of(const Mesh& mesh, Index f) {
  std::vector<Index> chain{f};
  Index side = longest_side(mesh, f);
  for (;;) {
    const Index across = mesh.face(mesh.twin(side));
    if (!mesh.is_triangle(across) || mesh.is_valid_face(across)) return chain;
    const Index longer = longest_side(mesh, across);
    if (!(mesh.length(longer) > mesh.length(side))) return chain;
    chain.push_back(across);
    side = longer;
  }
}

bool move_away(Mesh& mesh, Index f) {
  SmoothingOptions options;
  options.iterations = 0;
  const std::vector<Index> corners = topology::nodes_of(mesh, f);
  mesh.begin();
  const bool done = smoothing::smooth_near(mesh, options, corners, 0) && mesh.is_valid_face(f);
  done ? mesh.commit() : mesh.rollback();
  return done;
}

/// The first corner of a face as a row of the patch; nothing for a node of ours.
std::optional<ErrorSubject> subject_of(const Mesh& mesh, const std::vector<Index>& node, Index f) {
  const Index v = mesh.origin(mesh.half_edge(f));
  if (v >= node.size() || node[v] == kNone) return std::nullopt;
  return node_row(node[v]);
}

/// From the good triangle inwards: a swap needs one.
void repair_chain(Mesh& mesh, const std::vector<Index>& chain, const std::vector<Index>& node, const Plane& plane) {
  for (auto f = chain.rbegin(); f != chain.rend(); ++f)
    if (!mesh.is_valid_face(*f) && !swap_away(mesh, *f) && !move_away(mesh, *f))
      throw SurfaceError(
          "the triangle " + corners_of(mesh, plane, *f) + " has no area and its nodes are fixed; remove or collapse it",
          {.kind = ErrorKind::bad_element, .place = corner_of(mesh, plane, *f), .subject = subject_of(mesh, node, *f)});
}

}  // namespace

std::string corners_of(const Mesh& mesh, const Plane& plane, Index f) {
  std::string text;
  for (Index v : topology::nodes_of(mesh, f))
    text += (text.empty() ? "" : ", ") + describe(plane.to_space(mesh.point(v)));
  return text;
}

Eigen::Vector3d corner_of(const Mesh& mesh, const Plane& plane, Index f) {
  return plane.to_space(mesh.point(mesh.origin(mesh.half_edge(f))));
}

void repair_input(Mesh& mesh, const std::vector<Index>& node, const Plane& plane) {
  std::vector<Index> flat;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f) || mesh.is_valid_face(f)) continue;
    const auto n = topology::nodes_of(mesh, f);
    const std::array corners{mesh.point(n[0]), mesh.point(n[1]), mesh.point(n[2])};
    if (is_turned_over(corners)) throw turned_over(corners, plane, subject_of(mesh, node, f));
    flat.push_back(f);
  }
  for (Index f : flat)
    if (!mesh.is_valid_face(f)) repair_chain(mesh, chain_of(mesh, f), node, plane);
}

std::optional<SurfaceError> find_needles(const Mesh& mesh, const Plane& plane) {
  constexpr std::size_t kFew = 20;
  constexpr double kShare = 0.3;
  std::size_t faces = 0, thin = 0;
  Index first = kNone;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    ++faces;
    if (mesh.is_above(f, kStraightSine)) continue;
    if (++thin == 1) first = f;
  }
  if (thin <= kFew || double(thin) <= kShare * double(faces)) return {};
  return SurfaceError("no valid quads were found where " + std::to_string(thin) + " of " + std::to_string(faces) +
                          " triangles are more than a million times longer than high, the first at " +
                          corners_of(mesh, plane, first) + "; mesh the surface anew",
                      {.kind = ErrorKind::no_valid_mesh, .place = corner_of(mesh, plane, first)});
}

}  // namespace qmorph
