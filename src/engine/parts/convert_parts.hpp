// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>

#include "engine/pipeline.hpp"

namespace qmorph {

/// Whether convert_in_parts() is worth it for so many triangles: `Options::part_triangles`.
bool is_large(std::size_t triangles, const Options& options);

/// What all stages make of a region that is cut into parts, or nothing if it cannot be cut. The parts are worked on
/// side by side, front to cleanup; then they are joined, irregular nodes near the interfaces cancel, and the whole is
/// smoothed; all that for about as much work as is allowed (budget.hpp). `start` is what the front begins with,
/// `input` the region as it came (may be empty if no observer wants the stages).
std::optional<kernel::Mesh> convert_in_parts(kernel::Mesh start, const kernel::Mesh& input, const Plane& plane,
                                             const Options& options, double allowed, ConversionReport& report,
                                             Record& record);

}  // namespace qmorph
