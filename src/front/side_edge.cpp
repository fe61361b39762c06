// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <numbers>

#include "front/step.hpp"

namespace qmorph::front {

Index split_triangles(Step& step, Index h, const Vec2& p) {
  kernel::Mesh& mesh = step.mesh;
  const double size = 0.5 * (step.size[mesh.origin(h)] + step.size[mesh.target(h)]);
  const Index m = mesh.split_edge(h, p);
  step.colours.forget(m);
  step.size.set(m, size);
  for (Index side : Mesh::halves_of(h)) {
    // After the split, `side` ends (or starts) at m in a face of four sides: cut from m to the corner opposite.
    const Index from_m = mesh.origin(side) == m ? side : mesh.next(side);
    const Index f = mesh.face(from_m);
    if (f != kNone && mesh.degree(f) == 4) mesh.split_face(from_m, mesh.next(mesh.next(from_m)));
  }
  step.moved.push_back(m);
  return m;
}

namespace {

constexpr double kAnyAngle = std::numbers::pi;
/// A new side edge shorter than this times the input's edge length there would start a cascade of ever smaller
/// elements in a pocket of the front; the pocket's triangles are better left to triangle elimination.
constexpr double kShortestSide = 0.3;

bool is_too_short(const Step& step, Index node, const Vec2& end) {
  return (end - step.mesh.point(node)).norm() < kShortestSide * step.size[node];
}

struct Fan {
  Index best = kNone;  ///< interior edge of the fan nearest to the ideal direction
  double best_angle = kAnyAngle;
  Index wedge = kNone;  ///< outgoing half-edge of the triangle that the ideal direction enters
};

Fan look_around(const Step& step, const Corner& corner, const Taken& taken) {
  const Mesh& mesh = step.mesh;
  Fan fan;
  const Vec2 reference = mesh.vector(corner.outgoing);
  const Index last = Mesh::twin(corner.incoming);
  double angle = 0;
  fan.wedge = corner.outgoing;
  for (Index e = mesh.rotate_ccw(corner.outgoing); e != last; e = mesh.rotate_ccw(e)) {
    angle = ccw_angle(reference, mesh.vector(e));
    const double off = std::abs(angle - corner.ideal_angle);
    if (mesh.target(e) != taken.node && off < fan.best_angle) fan.best = e, fan.best_angle = off;
    if (angle <= corner.ideal_angle) fan.wedge = e;
  }
  return fan;
}

/// How far an existing edge may be off the ideal direction to serve as a side edge; one that has to be made may be off
/// by as much as the limit.
bool is_near(const Step& step, double off, bool is_there) {
  const double most = step.options.side_edge_angle;
  const bool is_near = off < most || (off == most && !is_there);
  if (step.decisions) step.decisions->side_edge.note(off, is_near);
  return is_near;
}

/// Where the ray from the corner's node in the ideal direction meets the edge of o; clamped to its inner part.
Vec2 ray_meets_edge(const Mesh& mesh, const Corner& corner, Index o) {
  constexpr double kMargin = 0.1;
  const Vec2 from = mesh.point(mesh.origin(corner.outgoing));
  const Vec2 ray = rotated(mesh.vector(corner.outgoing), corner.ideal_angle);
  const Vec2 a = mesh.point(mesh.origin(o)), edge = mesh.vector(o);
  const double denominator = cross(ray, edge);
  double s = denominator != 0 ? cross(from - a, ray) / -denominator : 0.5;
  if (!(s > kMargin)) s = kMargin;
  if (s > 1 - kMargin) s = 1 - kMargin;
  return a + s * edge;
}

/// The side edge by swapping o, the edge opposite the node; kNone if that is not good enough.
Index swap_for_side_edge(Step& step, const Corner& corner, const Taken& taken, Index o) {
  kernel::Mesh& mesh = step.mesh;
  const Index far = mesh.origin(mesh.prev(Mesh::twin(o)));
  if (far == taken.node || !mesh.can_flip(o)) return kNone;
  const Index node = mesh.origin(corner.outgoing);
  const Vec2 side = mesh.point(far) - mesh.point(node);
  const bool on_front = step.colours.is_coloured(far);
  if (on_front) {
    if (!step.colours.may_join(node, far)) return kNone;
  } else {
    const double off = std::abs(ccw_angle(mesh.vector(corner.outgoing), side) - corner.ideal_angle);
    const double most = step.options.side_edge_length * (mesh.length(corner.incoming) + mesh.length(corner.outgoing));
    if (side.norm() > most || !is_near(step, off, false)) return kNone;
  }
  mesh.flip(o);
  return Mesh::twin(o);
}

/// An edge must not close a loop of odd length: it ends half-way, at a new node.
Index without_odd_loop(Step& step, Index side) {
  const Index node = step.mesh.origin(side), far = step.mesh.target(side);
  if (!step.colours.is_coloured(far) || step.colours.may_join(node, far)) return side;
  const Vec2 middle = 0.5 * (step.mesh.point(node) + step.mesh.point(far));
  if (is_too_short(step, node, middle)) return kNone;
  split_triangles(step, side, middle);
  step.notes.side = SideEdge::halved;
  return side;
}

}  // namespace

Index define_side_edge(Step& step, const Corner& corner, const Taken& taken) {
  kernel::Mesh& mesh = step.mesh;
  const Fan fan = look_around(step, corner, taken);
  step.notes.side = SideEdge::existing;
  if (fan.best != kNone && is_near(step, fan.best_angle, true)) return without_odd_loop(step, fan.best);

  const Index opposite = mesh.next(fan.wedge);
  const bool is_free = mesh.is_triangle(mesh.face(Mesh::twin(opposite))) && opposite != taken.half_edge &&
                       Mesh::twin(opposite) != taken.half_edge;
  if (is_free) {
    if (const Index side = swap_for_side_edge(step, corner, taken, opposite); side != kNone)
      return step.notes.side = SideEdge::swapped, side;
    const Index node = mesh.origin(corner.outgoing);
    const Vec2 end = ray_meets_edge(mesh, corner, opposite);
    if (is_too_short(step, node, end)) return kNone;
    step.notes.side = SideEdge::split;
    return mesh.find(node, split_triangles(step, opposite, end));
  }
  // A front edge is opposite: an existing edge is taken at any angle, since the alternative is worse.
  return fan.best == kNone ? kNone : without_odd_loop(step, fan.best);
}

}  // namespace qmorph::front
