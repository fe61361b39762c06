// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A constrained Delaunay triangulation of a few hundred lattice points, exact, for making test domains.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace qmorph::test {

/// Coordinates stay within 2^22, so that every predicate is exact in 128 bits.
struct LatticePoint {
  std::int64_t x = 0, y = 0;
  auto operator<=>(const LatticePoint&) const = default;
};

enum class SegmentKind : std::uint8_t {
  boundary = 1,    ///< the domain is on one side of it
  constraint = 2,  ///< an edge to keep, the domain is on both sides
};

struct Segment {
  int from = 0, to = 0;
  SegmentKind kind = SegmentKind::boundary;
};

struct Triangulation {
  std::vector<std::array<int, 3>> triangles;    ///< counter-clockwise, those of the domain
  std::vector<std::array<int, 2>> constraints;  ///< the pieces of SegmentKind::constraint segments in the domain
};

/// Twice the area of abc, positive counter-clockwise.
std::int64_t orient(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c);

/// Triangulates all points, keeps what the SegmentKind::boundary segments enclose (even-odd rule: holes and islands
/// need no seed). A segment through a point is cut there. Nothing if two points are equal, two segments cross, or the
/// boundary is open.
std::optional<Triangulation> triangulate(const std::vector<LatticePoint>& points, const std::vector<Segment>& segments);

}  // namespace qmorph::test
