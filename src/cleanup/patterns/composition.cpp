// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/patterns/composition.hpp"

#include "topology/edits.hpp"

namespace qmorph::cleanup {
namespace {

using kernel::Mesh;

/// The dart's edge as the half-edge that leaves its node.
Index leaving(const Dart& d) { return d.at_target ? Mesh::twin(d.h) : d.h; }

void collect(const Mesh& mesh, Index f, std::vector<Index>& nodes) {
  for (Index v : topology::nodes_of(mesh, f)) nodes.push_back(v);
}

/// Two quads that share the edge of e and no other: their outline is a hexagon.
bool is_hexagon(const Mesh& mesh, Index e) {
  const Index t = Mesh::twin(e), f = mesh.face(e), g = mesh.face(t);
  return mesh.is_quad(f) && mesh.is_quad(g) && f != g && mesh.valence(mesh.origin(e)) > 2 &&
         mesh.valence(mesh.target(e)) > 2;
}

bool close(Mesh& mesh, Dart& d, bool half_way, std::vector<Index>& nodes) {
  if (!mesh.is_quad(mesh.face(d.h))) return false;
  collect(mesh, mesh.face(d.h), nodes);
  const Index beyond = mesh.face(Mesh::twin(d.h)), v = node_of(mesh, d), w = mesh.target(leaving(d));
  Index from = d.at_target ? mesh.next(d.h) : d.h, to = mesh.next(mesh.next(from));
  if (!mesh.is_free(v)) {
    if (!half_way) return false;
    std::swap(from, to);
  }
  const Index gone = mesh.origin(from), stays = mesh.origin(to);
  const Vec2 middle = 0.5 * (mesh.point(gone) + mesh.point(stays));
  const Index diagonal = mesh.split_face(from, to);
  if (!mesh.can_collapse(diagonal)) return false;
  mesh.collapse(diagonal);
  if (half_way && mesh.is_free(stays)) mesh.set_point(stays, middle);
  const Index e = mesh.find(stays, w);
  if (e == kNone) return false;
  d = mesh.face(e) == beyond ? Dart{e, false} : Dart{Mesh::twin(e), true};
  return true;
}

/// Cuts a quad off a face: the corner at origin(c), its two neighbours and a new node. Returns the half-edge of the
/// rest of the face that leaves the new node.
Index cut_corner(Mesh& mesh, Index c, std::vector<Index>& nodes) {
  const Index before = mesh.prev(c), after = mesh.next(c);
  const Vec2 p = 0.5 * (mesh.point(mesh.origin(before)) + mesh.point(mesh.origin(after)));
  const Index d = mesh.split_face(before, after);
  nodes.push_back(mesh.split_edge(d, p));
  return mesh.next(d);
}

/// The hexagon of the dart's edge, which goes; and a half-edge of it, beside v in the dart's element, that stays.
struct Hexagon {
  Index to_w, from_v;  ///< half-edges of its outline that leave w (in the left quad) and v (in the right one)
  Index kept;
  bool left;  ///< the dart's element is left of v -> w
};

bool open_hexagon(Mesh& mesh, const Dart& d, Hexagon& hexagon, std::vector<Index>& nodes) {
  const Index e = leaving(d), t = Mesh::twin(e);
  if (!is_hexagon(mesh, e)) return false;
  collect(mesh, mesh.face(e), nodes);
  collect(mesh, mesh.face(t), nodes);
  hexagon = {mesh.next(e), mesh.next(t), d.at_target ? mesh.next(t) : mesh.prev(e), !d.at_target};
  mesh.join_faces(e);
  return true;
}

/// The edge from v to the new node, on the side where the dart was.
Dart beside(const Mesh& mesh, const Hexagon& hexagon) {
  return hexagon.left ? Dart{mesh.next(hexagon.kept), false} : Dart{mesh.prev(hexagon.kept), true};
}

bool fill_3(Mesh& mesh, Dart& d, std::vector<Index>& nodes) {
  Hexagon hexagon;
  if (!open_hexagon(mesh, d, hexagon, nodes)) return false;
  const Index from_new = cut_corner(mesh, hexagon.to_w, nodes), n = mesh.origin(from_new);
  mesh.split_face(from_new, hexagon.from_v);
  const Vec2 before = mesh.point(n);  // between the nodes beside w
  mesh.set_point(n, (2 * before + mesh.point(mesh.origin(hexagon.from_v))) / 3);
  d = beside(mesh, hexagon);
  return true;
}

bool fill_4(Mesh& mesh, Dart& d, std::vector<Index>& nodes) {
  Hexagon hexagon;
  if (!open_hexagon(mesh, d, hexagon, nodes)) return false;
  // Around the hexagon: w, left beside w, left beside v, v, right beside v, right beside w. The corners cut off are the
  // node beside v in the element and the node beside w in the neighbour.
  const Index near = hexagon.left ? mesh.prev(hexagon.from_v) : mesh.next(hexagon.from_v);
  const Index far = hexagon.left ? mesh.prev(hexagon.to_w) : mesh.next(hexagon.to_w);
  const Index first = cut_corner(mesh, near, nodes), second = cut_corner(mesh, far, nodes);
  mesh.split_face(first, second);
  d = beside(mesh, hexagon);
  return true;
}

bool split_quad(Mesh& mesh, const Dart& d, std::vector<Index>& nodes) {
  if (!mesh.is_quad(mesh.face(d.h))) return false;
  collect(mesh, mesh.face(d.h), nodes);
  const Index from = d.at_target ? mesh.next(d.h) : d.h, to = mesh.next(mesh.next(from));
  const Vec2 middle = 0.5 * (mesh.point(mesh.origin(from)) + mesh.point(mesh.origin(to)));
  nodes.push_back(mesh.split_edge(mesh.split_face(from, to), middle));
  return true;
}

bool turn(Mesh& mesh, Dart& d, bool clockwise, std::vector<Index>& nodes) {
  const Index e = leaving(d), t = Mesh::twin(e);
  if (!is_hexagon(mesh, e)) return false;
  collect(mesh, mesh.face(e), nodes);
  collect(mesh, mesh.face(t), nodes);
  const Index from = clockwise ? mesh.prev(e) : mesh.next(mesh.next(t));
  const Index to = clockwise ? mesh.prev(t) : mesh.next(mesh.next(e));
  if (mesh.find(mesh.origin(from), mesh.origin(to)) != kNone) return false;
  mesh.join_faces(e);
  const Index turned = mesh.split_face(from, to);
  d.h = d.at_target ? Mesh::twin(turned) : turned;
  return true;
}

bool step(Mesh& mesh, Dart& d, char code, bool mirrored, std::vector<Index>& nodes) {
  if (mesh.face(d.h) == kNone) return false;  // the outside is no element
  switch (code) {
    case '0':
      d.at_target = !d.at_target;
      return true;
    case '1':
      d = d.at_target ? Dart{mesh.next(d.h), false} : Dart{mesh.prev(d.h), true};
      return true;
    case '2':
      d = {Mesh::twin(d.h), !d.at_target};
      return mesh.face(d.h) != kNone;
    case '3':
      return close(mesh, d, false, nodes);
    case '4':
      return close(mesh, d, true, nodes);
    case '5':
      return fill_3(mesh, d, nodes);
    case '6':
      return fill_4(mesh, d, nodes);
    case '7':
      return split_quad(mesh, d, nodes);
    case '8':
      return turn(mesh, d, !mirrored, nodes);
    case '9':
      return turn(mesh, d, mirrored, nodes);
  }
  return false;
}

}  // namespace

bool run(kernel::Mesh& mesh, Dart& dart, std::string_view composition, bool mirrored, std::vector<Index>& nodes) {
  for (char code : composition)
    if (!step(mesh, dart, code, mirrored, nodes)) return false;
  return true;
}

}  // namespace qmorph::cleanup
