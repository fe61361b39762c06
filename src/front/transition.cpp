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
  if (form_face(step, std::array{gap_out, Mesh::twin(chord), gap_in}, kMostTrianglesInGap) == kNone) return false;
  // The two triangles make a quad.
  const Index quad = mesh.face(mesh.join_faces(near_half));
  step.colours.colour_same(s.middle, k);
  step.moved.insert(step.moved.end(), {k, mesh.origin(chord), mesh.target(chord)});
  smooth_around(step, quad);
  if (!mesh.is_valid_star(s.middle) || !mesh.is_valid_face(quad)) return false;
  inherit_level(step, {chord, Mesh::twin(s.behind_p)}, level);
  return true;
}

Index transition_split(Step& step, Index longer, Index k) {
  kernel::Mesh& mesh = step.mesh;
  const unsigned level = step.front.level(longer);
  const SplitEdge s = split_longer(step, longer, k);
  if (s.middle == kNone) return kNone;

  // Behind is the ring k, m, p, x, y (or its mirror image). Cut y-p, put c on the cut, cut m-c: two quads
  // behind the front and the triangle m, p, c ahead of it.
  Vec2 centre = Vec2::Zero();
  Index h = s.behind_k;
  for (int i = 0; i < 5; ++i, h = mesh.next(h))
    if (mesh.origin(h) != s.middle) centre += mesh.point(mesh.origin(h)) / 4;
  // The thesis puts c at the centroid; in a parallelogram that is on the cut, a straight corner of the far quad.
  centre += kTowardsFront * (mesh.point(s.middle) - centre);
  const Index from_y = s.incoming ? mesh.prev(s.behind_k) : mesh.next(mesh.next(s.behind_k));
  const Index from_p = s.incoming ? mesh.next(s.behind_p) : s.behind_p;
  const Index cut = mesh.split_face(from_y, from_p);  // y -> p
  const Index c = mesh.split_edge(cut, centre);
  step.colours.forget(c);
  step.size.set(c, step.size[s.middle]);
  const Index ring = mesh.face(s.behind_k);
  const Index from_m = mesh.origin(s.behind_k) == s.middle ? s.behind_k : s.behind_p;
  Index from_c = from_m;
  while (mesh.origin(from_c) != c) from_c = mesh.next(from_c);
  if (mesh.face(from_m) != ring) return kNone;
  const Index mc = mesh.split_face(from_m, from_c);
  step.colours.colour_opposite(s.middle, k);
  step.colours.colour_same(c, k);
  step.moved.push_back(c);
  const Index base = step.front.contains(mc) ? mc : Mesh::twin(mc);
  smooth_around(step, mesh.face(Mesh::twin(base)));
  if (!step.front.contains(base) || !mesh.is_valid_star(c) || !mesh.is_valid_star(s.middle)) return kNone;
  h = mesh.out(c);
  do {
    inherit_level(step, {h, Mesh::twin(h)}, level);
    h = mesh.rotate_ccw(h);
  } while (h != mesh.out(c));
  inherit_level(step, {Mesh::twin(s.behind_k)}, level);
  return base;
}

}  // namespace qmorph::front
