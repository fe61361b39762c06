// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A front in Gmsh's window: what is behind and ahead of it, its edges, the base edge of the last step.

#include "cli/gui/front_log.hpp"
#include "cli/gui/panel.hpp"
#include "gmsh/window/shown_views.hpp"

namespace qmorph::cli {

void show_front(const FrontPlayer& player, FrontColour colour, adapter::ShownViews& views);

}  // namespace qmorph::cli
