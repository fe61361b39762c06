// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Bands with several curves on a side get as many segments on both.

#include <vector>

#include "parity/unknowns.hpp"

namespace qmorph::parity {

/// Bands by their shares. A curve between two bands that gets one more wants one more elsewhere in the next band, and
/// so on, until it is a curve with no further band: such paths of changes, the cheapest first, are what balances a flow
/// of least cost. Bands that no path of a fair price balances stay as they are.
/// \param step of all changes; 2 keeps parities
void balance(Unknowns& unknowns, const std::vector<std::vector<Share>>& bands, int step);

}  // namespace qmorph::parity
