// SPDX-License-Identifier: GPL-2.0-or-later
#include "elimination/certain.hpp"

#include <algorithm>
#include <array>

#include "topology/edits.hpp"

namespace qmorph::elimination {
namespace {

using kernel::Mesh;

/// Nodes of the quad that joining the triangle left of h with the triangle h, k, l would make; `far` is the node
/// across.
double joined_sine(const Mesh& mesh, Index h, Index far) {
  return topology::smallest_sine(mesh, {mesh.origin(h), far, mesh.target(h), mesh.target(mesh.next(h))});
}

/// Cuts the quad right of h so that a triangle lies there and the other part has the edge `exit`.
bool cut_behind(Mesh& mesh, Index h, Index exit) {
  const Index in = Mesh::twin(h), after = mesh.next(in), across = mesh.next(after), before = mesh.prev(in);
  if (exit == after) {
    mesh.split_face(exit, before);
  } else if (exit == before) {
    mesh.split_face(in, across);
  } else if (exit == across) {
    // Either diagonal will do: the one that gives the better quad on this side.
    if (joined_sine(mesh, h, mesh.target(after)) >= joined_sine(mesh, h, mesh.origin(before)))
      mesh.split_face(in, across);
    else
      mesh.split_face(after, before);
  } else {
    return false;
  }
  return true;
}

/// Places of the four nodes inside that divide a quad a, r, b, t with a straight or reflex corner r into five convex
/// ones:
///
///            t              r' and t' on the line from r to the corner across, a' and b' left and right of it, inside
///          / | \           the triangles a r' t' and b r' t', and between r' and t' as seen along the line. The angles
///        /   t'  \         at r' and t' towards a' and b' are acute, then, and every corner is convex.
///       /  a'  b' \        .
///      /  / r' \   \       .
///     / /   |    \  \      .
///    a      r       b
std::array<Vec2, 4> inner_places(const Vec2& a, const Vec2& r, const Vec2& b, const Vec2& t) {
  const Vec2 r1 = r + (t - r) / 3, t1 = r + (t - r) * 2 / 3, middle = (r1 + t1) / 2, axis = t1 - r1;
  const auto beside = [&](const Vec2& corner) {
    constexpr double kMostShare = 0.4, kMostShift = 0.25;  // of the way to the corner; of the axis, along it
    const double shift = std::abs((corner - middle).dot(axis)), most = kMostShift * axis.squaredNorm();
    return Vec2(middle + (shift * kMostShare > most ? most / shift : kMostShare) * (corner - middle));
  };
  return {beside(a), r1, beside(b), t1};
}

/// The two triangles at h become one quad or five.
bool pair_at(Mesh& mesh, Index h, std::vector<Index>& nodes) {
  const Index f = mesh.face(h), g = mesh.face(Mesh::twin(h));
  if (!mesh.is_triangle(f) || !mesh.is_triangle(g)) return false;
  if (mesh.face(Mesh::twin(mesh.next(h))) == g || mesh.face(Mesh::twin(mesh.prev(h))) == g) return false;
  Index corner = mesh.next(Mesh::twin(h));  // starts at one end of the edge that vanishes
  const Index quad = mesh.face(mesh.join_faces(h));
  for (Index v : topology::nodes_of(mesh, quad)) nodes.push_back(v);
  if (mesh.is_valid_face(quad)) return true;

  const auto sine_at = [&](Index e) {
    return corner_sine(mesh.point(mesh.origin(e)), mesh.point(mesh.target(e)), mesh.point(mesh.origin(mesh.prev(e))));
  };
  if (const Index other = mesh.next(mesh.next(corner)); sine_at(other) < sine_at(corner)) corner = other;
  // Counter-clockwise from the corner before the reflex one: a, r, b, t.
  std::vector<Index> loop{mesh.prev(corner)};
  while (loop.size() < 4) loop.push_back(mesh.next(loop.back()));
  std::array<Vec2, 4> outer;
  for (int i = 0; i < 4; ++i) outer[i] = mesh.point(mesh.origin(loop[i]));
  const std::vector<Index> copies = mesh.pillow(loop, 0);
  const std::array<Vec2, 4> inner = inner_places(outer[0], outer[1], outer[2], outer[3]);
  for (int i = 0; i < 4; ++i) {
    mesh.set_point(copies[i], inner[i]);
    nodes.push_back(copies[i]);
  }
  return std::all_of(copies.begin(), copies.end(), [&](Index v) { return mesh.is_valid_star(v); });
}

}  // namespace

bool pair_along(Mesh& mesh, std::span<const Index> path, std::vector<Index>& nodes) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Index h = path[i], beyond = mesh.face(Mesh::twin(h));
    if (beyond == kNone || mesh.face(h) == beyond) return false;
    if (mesh.is_quad(beyond) && (i + 1 == path.size() || !cut_behind(mesh, h, path[i + 1]))) return false;
    if (!pair_at(mesh, h, nodes)) return false;
  }
  return true;
}

}  // namespace qmorph::elimination
