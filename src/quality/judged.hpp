// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What whoever judges a result has to know of it, found once for all of them.

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "qmorph/certificate.hpp"
#include "qmorph/check.hpp"
#include "qmorph/export.hpp"
#include "qmorph/fidelity.hpp"
#include "qmorph/patch.hpp"
#include "qmorph/quality.hpp"
#include "space/result.hpp"

namespace qmorph {

/// A surface and what was made of it. Both must outlive this, and stay as they are.
class QMORPH_API Judged {
 public:
  Judged(const Patch& before, const QuadMesh& after);

  const Patch& before() const { return *before_; }
  const QuadMesh& after() const { return *after_; }
  /// plane_normal(before())
  const std::optional<Eigen::Vector3d>& plane() const { return plane_; }
  /// Where the result is on the surface; found when it is first asked for. \pre the result's elements have nodes
  const space::Result& on_surface();

  /// What the accumulators' own add() does, for those who have this.
  void add_to(QualityAccumulator& figures);
  void add_to(FidelityAccumulator& figures);

 private:
  const Patch* before_;
  const QuadMesh* after_;
  std::optional<Eigen::Vector3d> plane_;
  std::unique_ptr<const space::Result> on_surface_;
};

/// The public ones, for those who have this.
QMORPH_API std::optional<Defect> find_defect(Judged& judged, InputQuads quads, double beside);
QMORPH_API std::vector<PoorQuad> explain_poor_quads(Judged& judged, std::span<const double> scaled_jacobians,
                                                    double crease_angle);

}  // namespace qmorph
