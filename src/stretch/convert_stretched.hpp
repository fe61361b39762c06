// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A region of triangles that are stretched, and are no layers, becomes quads that are stretched alike.

#include <optional>

#include "engine/budget.hpp"
#include "engine/record.hpp"
#include "engine/regions.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"
#include "qmorph/report.hpp"

namespace qmorph::stretch {

struct StretchedQuads {
  kernel::Mesh mesh;
  bool in_chart = true;  ///< made as stretched as the triangles; else what convert_region() makes was better
};

/// As convert_region(), in a chart in which the triangles are about as long as wide; where that loses sizes or has a
/// poor quad, what convert_region() makes, if that is better. Nothing if the region is not stretched, has no such
/// chart, or has no valid result in it. Cost where nothing is stretched: some nanoseconds a triangle.
std::optional<StretchedQuads> convert_stretched(const Region& region, const Plane& plane, const Options& options,
                                                Budget& budget, ConversionReport& report, Record& record);

}  // namespace qmorph::stretch
