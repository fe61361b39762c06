// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "qmorph/options.hpp"

namespace qmorph {

/// The options that the caller asked for, with other constants of the front. Of a hundred that were tried on some
/// thousand small regions, each of these adds most to what those before it have reached.
std::vector<Options> front_variants(const Options& asked);

/// Fewer, for regions of curved surfaces, where a try costs more: other angles of corners and of side edges.
std::vector<Options> few_front_variants(const Options& asked);

}  // namespace qmorph
