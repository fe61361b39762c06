#pragma once
/// A second opinion on the engine's result, in space and against the input, before the model is touched.

#include <Eigen/Core>
#include <string>

#include "qmorph/patch.hpp"

namespace qmorph::adapter {

/// Unit normal that the elements of a planar patch follow: the direction of the sum of their area vectors.
Eigen::Vector3d patch_normal(const Patch& patch);

/// Whether all of a patch lies in one plane.
bool is_planar(const Patch& patch);

/// A quad of the input that is inverted, or has a corner of 180 degrees or more.
struct BadQuad {
  Index quad = kNone;  ///< kNone: there is none
  std::string where;   ///< "at (1, 2, 0)"
};
BadQuad find_bad_quad(const Patch& patch);

/// Whether the quads of the input have to be in the result.
enum class InputQuads { kept, free };

/// What is wrong with a result, with coordinates, or an empty string. Looks at the invariants I1 to I4 and I6 of the
/// design: boundary and constraint edges, fixed nodes, conformity, positive corners, area.
/// Cost: linear.
std::string find_defect(const Patch& patch, const QuadMesh& mesh, InputQuads quads = InputQuads::kept);

}  // namespace qmorph::adapter
