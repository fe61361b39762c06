// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The cases of cleanup that are recognised by valences, as data [thesis, appendix, tables 1 to 3; after Kinney].

#include <span>
#include <string_view>

namespace qmorph::cleanup {

/// A centre and the ring of nodes around it, and what to do there.
///
/// `valences` is a valence pattern as the glossary has it: the centre's valence, a dash, then counter-clockwise the
/// valences of the ring, a neighbour of the centre first, then the node across the element that follows, and so
/// on. `4+` is 4 or more, `4-` is 4 or less, 0 is any. Around a node of the boundary the first of the ring is
/// the neighbour with the outside on its right.
///
/// The other patterns have one digit for a node of the ring; an empty one asks for nothing. A 1 means:
///   vertices   the node is a corner of the outline: its angle there is smaller than that of every node with 0
///   interior   the node is not on the boundary (0: it may be either)
///   boundary   the node is on the boundary, and with 0 it is not; the first digit stands for the centre
///
/// `composition` starts at the centre, on the edge to the first of the ring, in the element that follows.
struct Case {
  std::string_view name;
  std::string_view valences, vertices, interior, boundary;
  std::string_view composition;
};

/// Tables 1 and 2.
std::span<const Case> connectivity_cases();
/// Table 3.
std::span<const Case> boundary_cases();

/// What is recognised by a large angle. `composition` starts at the node of that angle, on one of the element's
/// two edges there, in the element.
struct ShapeCase {
  std::string_view name;
  int boundary_edges;  ///< how many of the element's edges at the node are on the boundary
  std::string_view composition;
};

/// A large angle in an element: thesis 3.6.1 and 3.6.5, "combine with neighbour".
std::span<const ShapeCase> large_angle_cases();
/// A large angle between two edges of the boundary: a triangularly shaped quad, thesis 3.6.4.
std::span<const ShapeCase> transition_cases();

}  // namespace qmorph::cleanup
