// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Compositions: what the thesis (3.6.2) writes a replacement pattern in. A dart goes from element to element by the
/// alpha-iterators 0, 1, 2 and changes the mesh where it is by the codes 3 to 9 of table 3.1.

#include <string_view>
#include <vector>

#include "kernel/mesh.hpp"

namespace qmorph::cleanup {

/// One element, one of its edges, one end of that edge [thesis, footnote 5 of chapter 3].
struct Dart {
  Index h = kNone;         ///< the edge; the element is face(h)
  bool at_target = false;  ///< the node is target(h), else origin(h)
};

inline Index node_of(const kernel::Mesh& mesh, const Dart& d) {
  return d.at_target ? mesh.target(d.h) : mesh.origin(d.h);
}

/// Runs a composition from `dart`; topology only. Appends the nodes of every element that it changes, and the new
/// nodes, to `nodes` (vanished and repeated ones among them). False, perhaps half-way, where a step is impossible:
/// to be called in a transaction. `dart` ends where the composition leaves it.
///
/// A digit is a step; the node of the dart is v, the other end of its edge w:
///   0  the other end           1  the other edge at v in the element          2  the other element at the edge
///   3  close the element (a quad): v goes to the opposite node, and must be free to go
///   4  the same, and both meet half-way (where one of them may not move, at that one)
///   5  fill_3: the element and its neighbour across the edge, a hexagon, become three quads around a new node that is
///      joined to v and to the nodes beside w. w loses an edge, v keeps its number.
///   6  fill_4: the hexagon becomes four quads around two new nodes, one joined to v and to the node beside w in the
///      element, the other to w and to the node beside v in the neighbour. v and w keep their numbers.
///   7  a new node in the middle of the element, joined to v and to the opposite node
///   8  the edge moves on clockwise inside the hexagon          9  ... counter-clockwise The dart follows: after 3 and
///   4 it is on the edge that was left of v-w, beyond it, at the merged node; after 5 and 6 on the edge from v to the
///   new node; after 8 and 9 on the edge that moved, at the end that was v. It stays on its side. `mirrored` exchanges
///   8 and 9: the composition of the mirror image.
bool run(kernel::Mesh& mesh, Dart& dart, std::string_view composition, bool mirrored, std::vector<Index>& nodes);

}  // namespace qmorph::cleanup
