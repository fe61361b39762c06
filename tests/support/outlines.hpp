// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Domains that are drawn by their outlines: polygons with holes, wedges, rings, combs, channels, networks.

#include <optional>
#include <string>

#include "support/draft.hpp"
#include "support/rng.hpp"

namespace qmorph::test {

/// Draws one, of a kind that the generator picks; the kind's name is put into `name`. Nothing if lines happened to
/// cross.
std::optional<Draft> drawn_domain(Rng& rng, std::string& name);

}  // namespace qmorph::test
