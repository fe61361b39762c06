// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Improves the mesh in a window of a surface.

#include <optional>

#include "chart/divide.hpp"
#include "chart/ground.hpp"
#include "chart/rework.hpp"
#include "qmorph/options.hpp"

namespace qmorph::chart {

struct WindowResult {
  std::optional<Reworked> better;  ///< nothing if it was better before
  std::size_t work = 0;            ///< as kernel::Mesh::work() counts it, in either case
};

/// Irregular nodes cancel, and the rest is smoothed; for about as much work as is allowed.
WindowResult clean_window(const LaidOut& window, const Options& options, const Ground& ground, double allowed);

/// Cancels irregular nodes that lie so far apart that looking for them everywhere would cost too much;
/// for about as much work as is allowed.
WindowResult cancel_in_window(const LaidOut& window, const Options& options, const Ground& ground, double allowed);

}  // namespace qmorph::chart
