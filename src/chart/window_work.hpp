// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Improves the mesh in a window of a surface. Nothing is returned if it was better before.

#include <optional>

#include "chart/divide.hpp"
#include "chart/ground.hpp"
#include "chart/rework.hpp"
#include "qmorph/options.hpp"

namespace qmorph::chart {

/// Irregular nodes cancel, and the rest is smoothed.
std::optional<Reworked> clean_window(const LaidOut& window, const Options& options, const Ground& ground);

/// Cancels irregular nodes that lie so far apart that looking for them everywhere would cost too much.
std::optional<Reworked> cancel_in_window(const LaidOut& window, const Options& options, const Ground& ground);

}  // namespace qmorph::chart
