// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Domains that no mesh generator should make, though some do. Made without Gmsh; every seed gives a valid patch.

#include <cstdint>

#include "support/domains.hpp"

namespace qmorph::test {

/// Up to about 3000 triangles. Hundreds of triangles around one node, inside or on the boundary; outlines that were
/// triangulated without a node inside; gaps that are one triangle wide; needles at corners; chains of holes that
/// touch at nodes; slits side by side; triangles scattered among quads. At any scale from 1e-6 to 1e6, up to ten
/// thousand times its size away from the origin, in any plane, clockwise, renumbered.
Domain nasty_domain(std::uint64_t seed);

}  // namespace qmorph::test
