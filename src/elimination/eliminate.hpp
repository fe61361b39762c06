#pragma once
/// Triangle elimination: what makes invariant I5 a guarantee. Design section 4, "Triangle elimination".

#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::elimination {

/// Pairs the triangles that are left, best shape first, then passes triangles along the shortest chain of
/// elements to one another until at most one is left. Valid elements stay valid. Returns the number of
/// triangles left: 0 or 1 unless the geometry allowed no chain.
std::size_t eliminate_triangles(kernel::Mesh& mesh, const SmoothingOptions& smoothing);

}  // namespace qmorph::elimination
