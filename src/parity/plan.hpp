// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Which sides to split so that every region gets an even number of them: a T-join.
///
/// A region can be made of quads alone if its boundary has an even number of sides. To split an edge of the mesh that
/// two regions share changes the parity of both; an edge of the outside changes that of one. So regions are the nodes
/// of a graph, shared edges its links, and a set of links that meets exactly the odd regions an odd number of times is
/// what is wanted; the outside takes any number. The cheapest such set consists of paths that pair the odd regions
/// [J. Edmonds, E. Johnson, Matching, Euler tours and the Chinese postman, 1973].
///
/// Where surfaces meet in space an edge may be shared by three and more, and be no link of a graph. Such edges are
/// split where all others are not enough (shared_by_many.hpp).

#include <cstdint>
#include <vector>

#include "qmorph/export.hpp"
#include "qmorph/index.hpp"

namespace qmorph::parity {

/// The outside, as a region.
inline constexpr Index kOutside = kNone;

/// An edge of the mesh that may get a node, or several that get one together.
struct Link {
  Index a = kOutside, b = kOutside;  ///< the regions on its two sides
  double length = 0;                 ///< of the shortest
  int splits = 1;                    ///< how many edges
  std::vector<Index> others = {};    ///< further regions that it changes, each named once
};

/// The same with a price.
struct PricedLink {
  Index a = kOutside, b = kOutside;
  std::int64_t cost = 0;  ///< 0 .. 2^50
  std::vector<Index> others = {};
};

struct Plan {
  std::vector<Index> splits;    ///< links to split, in order
  std::vector<Index> odd_left;  ///< regions that stay odd because too few links lead to them
};

/// The fewest splits, and of those with as few the ones on the longest edges. As many regions become even as the links
/// allow. Exact, unless more than 160 odd regions hang together: of these some are paired with what is near; and but
/// for links of three and more regions, of which cheap ones are taken. Cost: (odd regions) * (links) * log, the
/// matching of the odd regions, and (links of three and more that differ) * (sets of regions that no other link
/// leaves)^2.
QMORPH_API Plan plan_splits(const std::vector<bool>& odd, const std::vector<Link>& links);
/// The same for the least sum of costs.
QMORPH_API Plan plan_cheapest(std::vector<bool> odd, const std::vector<PricedLink>& links);

}  // namespace qmorph::parity
