// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Why the poor quads of a result are poor: what the input forces, and what it does not.

#include <Eigen/Core>
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "qmorph/export.hpp"
#include "qmorph/options.hpp"
#include "qmorph/patch.hpp"

namespace qmorph {

enum class PoorBecause {
  kept,            ///< it is a quad of the input
  boundary_angle,  ///< a corner between two kept edges is too sharp for any quad, or it is alone between four kept edges
  narrow,          ///< kept edges or nodes on either side of it are nearer to each other than they are long
  odd_region,      ///< it is beside the one triangle that a region with an odd boundary must have
  input_geometry,  ///< the surface is folded or turns sharply within it
  nothing,         ///< nothing forces it: it is ours
};
inline constexpr std::size_t kPoorReasons = 6;

/// "the angles of its boundary", ...
QMORPH_API std::string_view name_of(PoorBecause reason);

struct PoorQuad {
  Index quad = kNone;  ///< row of `QuadMesh::quads`
  double scaled_jacobian = 0;
  PoorBecause reason = PoorBecause::nothing;
  Eigen::Vector3d where = Eigen::Vector3d::Zero();  ///< its centre
};

/// A quad is poor below this scaled Jacobian [Verdict].
inline constexpr double kPoorQuad = 0.3;

/// Looks at each quad of a result whose scaled Jacobian (`scaled_jacobians`, one for each quad) is below kPoorQuad.
/// Edges that are kept are constraints, the boundary, and creases (`Options::crease_angle`). Cost: linear, and next to
/// nothing where no quad is poor.
QMORPH_API std::vector<PoorQuad> explain_poor_quads(const Patch& before, const QuadMesh& after,
                                                    std::span<const double> scaled_jacobians,
                                                    double crease_angle = Options{}.crease_angle);

}  // namespace qmorph
