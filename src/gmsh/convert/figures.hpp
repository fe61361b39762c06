// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The figures of surfaces, one by one and together.

#include "gmsh/convert/replace.hpp"
#include "gmsh/model/patches.hpp"
#include "qmorph/fidelity.hpp"
#include "qmorph/gmsh.hpp"
#include "qmorph/quality.hpp"

namespace qmorph::adapter {

class Figures {
 public:
  explicit Figures(const Options& options) : crease_angle_(options.crease_angle) {}

  /// Of a result that has been checked: elements, quality, what makes quads poor, sizes.
  void add_result(ConvertedSurface& converted, SurfaceReport& report);
  /// Warns where quads that were to be improved had to become worse. \pre add_result
  void compare_with_input(const ConvertedSurface& converted, SurfaceReport& report);
  /// Of a surface that stays as it is. \param before to compare it with; may be null
  void add_as_it_is(const SurfaceMesh& surface, const Patch* before, SurfaceReport& report);
  /// Of all of them together.
  void put_into(ModelReport& report) const;

 private:
  const double crease_angle_;
  QualityAccumulator total_;
  QualityAccumulator total_before_;  ///< of quads that were to be improved
  FidelityAccumulator fidelity_;
  OnGeometry on_geometry_;
};

}  // namespace qmorph::adapter
