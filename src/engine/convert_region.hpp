// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One region of triangles becomes quads.

#include "engine/budget.hpp"
#include "engine/pipeline.hpp"
#include "engine/regions.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"
#include "qmorph/report.hpp"

namespace qmorph {

/// How often the front may begin anew.
enum class Tries { as_many_as_pay, one };

/// All stages on one region. In a small region a single decision of the front decides how good the result is, and
/// nobody can tell which: if the result is poor, other constants of the front are tried as well
/// (`Options::retry_triangles`), and the best result is taken, all for about as much work as the budget has left. With
/// `Tries::one` there are no others.
/// \throws SurfaceError if no valid result was found
kernel::Mesh convert_region(const Region& region, const Plane& plane, const Options& options, Budget& budget,
                            ConversionReport& report, Record& record, Tries tries = Tries::as_many_as_pay);

}  // namespace qmorph
