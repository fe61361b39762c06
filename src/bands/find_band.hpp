// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Regions that are thin bands: rings and strips with room for a few rows of quads.

#include <optional>
#include <vector>

#include "engine/regions.hpp"

namespace qmorph::bands {

/// No band has more rows.
constexpr int kMostRows = 4;

/// Two sides that face each other, both in the direction in which the band is on the left of `lower`. A ring has its
/// first nodes again as the last ones; the ends of a strip run from `lower` to `upper`, with the corners.
struct Band {
  std::vector<Index> lower, upper;  ///< `lower` has as many nodes as `upper`, or more
  bool is_ring = false;
  std::vector<Index> start, end;  ///< of a strip
  double rows = 1;                ///< of quads that take the place of its triangles, on average
};

using Loop = std::vector<Index>;

/// What counts as a band.
struct BandLimits {
  std::size_t least_edges = 6;     ///< of the shorter side
  bool may_have_any_ends = false;  ///< the corners of a strip are the four sharpest nodes, whatever their angles
};
/// Where other ways have failed.
constexpr BandLimits kAnyBand{2, true};

/// `lower` is to have the more nodes: else the band is turned by half a turn.
void put_longer_below(Band& band);

/// Its nodes once round, counter-clockwise; those in the band become places among them.
std::vector<Index> renumber(Band& band);

/// The boundary, the region on the left of each loop.
std::vector<Loop> boundary_of(const Region& region);

/// Nothing if the region is no band. How thick it may be is for find_facing() to say. Cost: linear.
std::optional<Band> find_band(const Region& region, const BandLimits& limits = {});

/// For each node of `lower` the node of `upper` that it faces: the nearest one, never one before that of the node
/// before. Those of a ring may run on beyond `upper`, around once more; its `upper` is rotated such that they begin
/// with 0.
struct Facing {
  std::vector<Index> node;
  std::vector<double> rows;  ///< that are wanted there
};

/// The sides of a band are so many edges apart, at most.
constexpr double kLargestGap = 3.6;

/// Nothing if the sides are farther apart.
std::optional<Facing> find_facing(Band& band, const std::vector<Vec2>& points, double largest_gap = kLargestGap);

}  // namespace qmorph::bands
