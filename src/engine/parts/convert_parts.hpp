#pragma once
#include <optional>

#include "engine/pipeline.hpp"

namespace qmorph {

/// What all stages make of a region that is large enough to be cut into parts (`Options::part_triangles`); nothing if it is not. The
/// parts are worked on side by side, front to cleanup; then they are joined, irregular nodes near the interfaces cancel, and
/// the whole is smoothed. `start` is what the front begins with, `input` the region as it came (may be empty without
/// `snapshots`, which may be null).
std::optional<kernel::Mesh> convert_in_parts(const kernel::Mesh& start, const kernel::Mesh& input, const Plane& plane,
                                             const Options& options, ConversionStats& stats, Snapshots* snapshots);

}  // namespace qmorph
