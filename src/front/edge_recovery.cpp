// SPDX-License-Identifier: GPL-2.0-or-later
#include "front/step.hpp"
#include "geometry/predicates.hpp"

namespace qmorph::front {
namespace {

/// If it takes more swaps than this for each crossed edge, the segment cannot be recovered.
constexpr std::size_t kSwapsPerEdge = 6;
/// A top edge must not cross more triangles than this.
constexpr std::size_t kMostCrossings = 64;

struct Crossings {
  bool blocked = false;
  std::vector<Index> edges;
};

/// The outgoing half-edge of origin(h) whose triangle the segment to p enters, counter-clockwise from h;
/// `found` is set if v itself is a neighbour on the way.
Index entered_wedge(const Mesh& mesh, Index h, Index v, Index& found) {
  const Vec2& from = mesh.point(mesh.origin(h));
  const Vec2& to = mesh.point(v);
  Index e = h;
  while (mesh.is_triangle(mesh.face(e))) {
    if (mesh.target(e) == v) return found = e, kNone;
    const Index following = mesh.rotate_ccw(e);
    if (mesh.target(following) == v) return found = following, kNone;
    if (orientation(from, mesh.point(mesh.target(e)), to) > 0 &&
        orientation(from, mesh.point(mesh.target(following)), to) < 0)
      return e;
    e = following;
    if (e == h) break;
  }
  return kNone;
}

Crossings find_crossings(const Mesh& mesh, Index wedge, Index v) {
  const Vec2 from = mesh.point(mesh.origin(wedge)), to = mesh.point(v);
  Crossings crossed;
  Index e = mesh.next(wedge);  // crossed from its left, right to left as seen along the segment
  while (crossed.edges.size() < kMostCrossings) {
    const Index t = Mesh::twin(e);
    if (!mesh.is_triangle(mesh.face(t))) break;
    crossed.edges.push_back(e);
    const Index apex = mesh.target(mesh.next(t));
    if (apex == v) return crossed;
    const int side = orientation(from, to, mesh.point(apex));
    if (side == 0) break;  // a node lies on the segment
    e = side > 0 ? mesh.next(t) : mesh.prev(t);
  }
  crossed.blocked = true;
  return crossed;
}

bool crosses(const Mesh& mesh, Index e, const Vec2& from, const Vec2& to) {
  const Vec2 &a = mesh.point(mesh.origin(e)), &b = mesh.point(mesh.target(e));
  return orientation(from, to, a) * orientation(from, to, b) < 0 && orientation(a, b, from) * orientation(a, b, to) < 0;
}

}  // namespace

Index recover_edge(Step& step, Index h, Index v) {
  kernel::Mesh& mesh = step.mesh;
  step.notes.swaps = 0;
  const Index start = mesh.origin(h);
  Index found = kNone;
  const Index wedge = entered_wedge(mesh, h, v, found);
  if (found != kNone) return found;
  if (wedge == kNone) return kNone;
  Crossings crossed = find_crossings(mesh, wedge, v);
  if (crossed.blocked) return kNone;

  const Vec2 from = mesh.point(start), to = mesh.point(v);
  std::size_t budget = kSwapsPerEdge * crossed.edges.size();
  for (std::size_t i = 0; i < crossed.edges.size(); ++i) {
    if (budget-- == 0) return kNone;
    const Index e = crossed.edges[i];
    if (!mesh.can_flip(e)) {
      crossed.edges.push_back(e);  // its turn comes when its neighbours have turned
      continue;
    }
    mesh.flip(e);
    ++step.notes.swaps;
    if (crosses(mesh, e, from, to)) crossed.edges.push_back(e);
  }
  return mesh.find(start, v);
}

}  // namespace qmorph::front
