// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The stages of the engine on parts of a region, each in its chart.

#include "chart/divide.hpp"
#include "chart/ground.hpp"
#include "engine/convert_region.hpp"
#include "engine/record.hpp"
#include "qmorph/report.hpp"

namespace qmorph::chart {

/// Triangles that are converted, or triangles and quads that are improved.
enum class Task { convert, improve };

struct PartWork {
  kernel::Mesh mesh;
  bool is_stretched = false;  ///< made for stretched triangles: squares are not what its quads are to be
};

/// What all stages make of a part, for about as much work as the budget has left. \throws SurfaceError if no valid
/// result was found
PartWork work_on_part(const LaidOut& part, const Ground& ground, const Options& options, Budget& budget, Task task,
                      ConversionReport& report, Record& record, Tries tries);

}  // namespace qmorph::chart
