#pragma once
#include "kernel/mesh.hpp"

namespace qmorph {

struct Plane;

/// Makes the triangles of a region fit to start from: zero-area triangles are turned away by a swap of their longest side
/// or by moving a free corner. Throws SurfaceError where that is impossible, or where a triangle is turned over,
/// which means that triangles overlap.
void repair_input(kernel::Mesh& mesh, const Plane& plane);

}  // namespace qmorph
