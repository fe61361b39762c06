// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Edges that three and more surfaces share: to split one changes the parity of all of them.
///
/// Links of one or two regions bring oddness together, and out, as far as they lead; what they join is an island, and
/// its parity is all that is left to say of it. An island from which a link leads to the outside can be made even in
/// any case. The others ask for a set of links of many regions that changes the odd ones among them, which is a linear
/// system over two elements.

#include <vector>

#include "parity/plan.hpp"

namespace qmorph::parity {

/// All regions that a link changes.
std::vector<Index> regions_of(const PricedLink& link);

/// Those links of three and more regions, in order, that leave as little as may be for links of one and two to do, and
/// nothing where these are enough. Cheap ones come first, but their sum need not be the least.
std::vector<Index> choose_shared_by_many(const std::vector<bool>& odd, const std::vector<PricedLink>& links);

}  // namespace qmorph::parity
