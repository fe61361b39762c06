// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "space/background.hpp"
#include "stretch/metric_field.hpp"

namespace qmorph::chart {

/// The surface under a mesh, and how its triangles are stretched: null if they are not.
struct Ground {
  const space::Background& background;
  const stretch::MetricField* field = nullptr;
};

}  // namespace qmorph::chart
