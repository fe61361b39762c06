// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Domains that are cut out of a mesh triangle by triangle, so that any topology occurs; and tiny ones.

#include <optional>
#include <string>

#include "support/draft.hpp"
#include "support/rng.hpp"

namespace qmorph::test {

/// A lattice or a cloud of points, masked. Nothing if too little is left.
std::optional<Draft> cut_out_domain(Rng& rng, std::string& name);

/// One triangle, fans, wheels, strips, polygons without an inner node: 1 to 40 triangles.
std::optional<Draft> tiny_domain(Rng& rng, std::string& name);

}  // namespace qmorph::test
