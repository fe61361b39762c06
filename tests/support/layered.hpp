// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Random domains with boundary layers and structured strips.

#include <cstdint>

#include "support/layer_builder.hpp"

namespace qmorph::test {

/// Layers of 3 to 40 rows, first cells of 1e-6 to 1e-1 of the spacing, jitter up to 15 %; around bodies with smooth
/// walls, sharp corners with fans and concave ones, round plates, in cavities and channels, in corners where two walls
/// meet, in wedges where rows end, in strips and rings that touch no wall, and structured from wall to wall. Every seed
/// gives one.
LayeredDomain layered_domain(std::uint64_t seed);

}  // namespace qmorph::test
