// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The stages of the engine on parts of a region, each in its chart.

#include "chart/divide.hpp"
#include "engine/convert_region.hpp"
#include "engine/record.hpp"
#include "qmorph/report.hpp"

namespace qmorph::chart {

/// Triangles that are converted, or triangles and quads that are improved.
enum class Task { convert, improve };

/// What all stages make of a part, for about as much work as is allowed. \throws SurfaceError if no valid result was
/// found
kernel::Mesh work_on_part(const LaidOut& part, const Options& options, double allowed, Task task,
                          ConversionReport& report, Record& record, Tries tries);

}  // namespace qmorph::chart
