// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <array>

#include "front/step.hpp"

namespace qmorph::front {
namespace {

constexpr std::size_t kMostTrianglesInGap = 24;

/// Half an edge shorter than this times the input's edge length there is not worth a split: the transition is
/// no fault of the longer edge.
constexpr double kLeastHalf = 0.7;

/// How far the node behind a split edge moves from the centroid of its quad to the edge's middle.
constexpr double kTowardsFront = 0.4;

/// The longer of two front edges at k, split at its middle, and the five-sided face behind it.
struct SplitEdge {
  Index middle = kNone;    ///< new node
  Index behind_k = kNone;  ///< half-edge behind the front between k and the middle
  Index behind_p = kNone;  ///< half-edge behind the front between the middle and the far node p
  bool incoming = false;   ///< the longer edge ended at k
};

/// Splits the longer edge and the triangle ahead of it. Behind must be a quad.
SplitEdge split_longer(Step& step, Index longer, Index k) {
  kernel::Mesh& mesh = step.mesh;
  SplitEdge s;
  s.incoming = mesh.target(longer) == k;
  if (!mesh.is_quad(mesh.face(Mesh::twin(longer)))) return s;
  if (mesh.length(longer) < kLeastHalf * 2 * step.size[k]) return s;
  const Index m =
      split_triangles(step, longer, 0.5 * (mesh.point(mesh.origin(longer)) + mesh.point(mesh.target(longer))));
  s.middle = m;
  // `longer` now ends at m; behind it runs its twin, and the other half lies next to that.
  const Index half = Mesh::twin(longer);
  const Index other = mesh.origin(half) == m ? mesh.prev(half) : mesh.next(half);
  const bool half_is_k = mesh.origin(half) == k || mesh.target(half) == k;
  s.behind_k = half_is_k ? half : other;
  s.behind_p = half_is_k ? other : half;
  return s;
}

void inherit_level(Step& step, std::initializer_list<Index> edges, unsigned level) {
  for (Index e : edges)
    if (step.front.contains(e)) step.front.set_level(e, level);
}

}  // namespace

bool transition_seam(Step& step, Index incoming, Index outgoing) {
  kernel::Mesh& mesh = step.mesh;
  const Index k = mesh.target(incoming);
  if (mesh.origin(incoming) == mesh.target(outgoing)) return false;
  const unsigned level = std::max(step.front.level(incoming), step.front.level(outgoing));
  const bool is_incoming_longer = mesh.length(incoming) > mesh.length(outgoing);
  const SplitEdge s = split_longer(step, is_incoming_longer ? incoming : outgoing, k);
  if (s.middle == kNone) return false;

  // Behind the front: cut the triangle (k, middle, y) off the five-sided face.
  if (s.incoming)
    mesh.split_face(mesh.prev(s.behind_k), mesh.next(s.behind_k));
  else
    mesh.split_face(s.behind_k, mesh.next(mesh.next(s.behind_k)));
  // Ahead: close the gap between the near half and the shorter edge with a triangle.
  const Index near_half = Mesh::twin(s.behind_k);
  const Index gap_in = s.incoming ? near_half : incoming;
  const Index gap_out = s.incoming ? outgoing : near_half;
  const Index chord = recover_edge(step, gap_in, mesh.target(gap_out));
  if (chord == kNone) return false;
  if (form_face(step, std::array<Index, 3>{gap_out, Mesh::twin(chord), gap_in}, kMostTrianglesInGap) == kNone)
    return false;
  // The two triangles make a quad.
  const Index quad = mesh.face(mesh.join_faces(near_half));
  step.colours.colour_same(s.middle, k);
  step.moved.insert(step.moved.end(), {k, mesh.origin(chord), mesh.target(chord)});
  smooth_around(step, quad);
  if (!mesh.is_valid_star(s.middle) || !mesh.is_valid_face(quad)) return false;
  inherit_level(step, {chord, Mesh::twin(s.behind_p)}, level);
  return true;
}

namespace {

/// Where the new node behind a split edge goes. The thesis has it at the centroid of the quad; in a parallelogram that
/// is on the cut from y to p, and makes a straight corner.
Vec2 place_behind(const kernel::Mesh& mesh, const SplitEdge& s) {
  Vec2 centroid = Vec2::Zero();
  Index h = s.behind_k;
  for (int i = 0; i < 5; ++i, h = mesh.next(h))
    if (mesh.origin(h) != s.middle) centroid += mesh.point(mesh.origin(h)) / 4;
  return centroid + kTowardsFront * (mesh.point(s.middle) - centroid);
}

/// Cuts the five-sided face behind a split edge (mirrored where the edge ended at k):
///
///   k----m--------p       k----m--------p       k----m--------p    ahead: the front, from k to p
///   |             |       |           / |       |     \     / |
///   |             |  -->  |       c     |  -->  |       c     |    behind: the quad k, p, x, y, whose side
///   |             |       |   /         |       |   /         |    from k to p has got the node m
///   y-------------x       y-------------x       y-------------x
///
/// First from y to p, then the cut gets the node c, and an edge from m to c divides what is left at m. That gives the
/// quads k, m, c, y and y, c, p, x, and the triangle m, c, p, which the front takes ahead of it again.
/// Returns the half-edge m -> c, or kNone where that is not possible.
Index cut_behind(Step& step, const SplitEdge& s) {
  kernel::Mesh& mesh = step.mesh;
  const Vec2 place = place_behind(mesh, s);
  const Index from_y = s.incoming ? mesh.prev(s.behind_k) : mesh.next(mesh.next(s.behind_k));
  const Index from_p = s.incoming ? mesh.next(s.behind_p) : s.behind_p;
  const Index c = mesh.split_edge(mesh.split_face(from_y, from_p), place);
  step.colours.forget(c);
  step.size.set(c, step.size[s.middle]);
  const Index from_m = mesh.origin(s.behind_k) == s.middle ? s.behind_k : s.behind_p;
  if (mesh.face(from_m) != mesh.face(s.behind_k)) return kNone;
  Index from_c = from_m;
  while (mesh.origin(from_c) != c) from_c = mesh.next(from_c);
  return mesh.split_face(from_m, from_c);
}

}  // namespace

Index transition_split(Step& step, Index longer, Index k) {
  kernel::Mesh& mesh = step.mesh;
  const unsigned level = step.front.level(longer);
  const SplitEdge s = split_longer(step, longer, k);
  if (s.middle == kNone) return kNone;
  const Index mc = cut_behind(step, s);
  if (mc == kNone) return kNone;
  const Index c = mesh.target(mc);
  step.colours.colour_opposite(s.middle, k);
  step.colours.colour_same(c, k);
  step.moved.push_back(c);
  const Index base = step.front.contains(mc) ? mc : Mesh::twin(mc);
  smooth_around(step, mesh.face(Mesh::twin(base)));
  if (!step.front.contains(base) || !mesh.is_valid_star(c) || !mesh.is_valid_star(s.middle)) return kNone;
  for (Index h : mesh.around(c)) inherit_level(step, {h, Mesh::twin(h)}, level);
  inherit_level(step, {Mesh::twin(s.behind_k)}, level);
  return base;
}

}  // namespace qmorph::front
