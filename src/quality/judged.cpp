// SPDX-License-Identifier: GPL-2.0-or-later
#include "quality/judged.hpp"

#include "quality/shapes.hpp"

namespace qmorph {

Judged::Judged(const Patch& before, const QuadMesh& after)
    : before_(&before), after_(&after), plane_(plane_normal(before)) {}

const space::Result& Judged::on_surface() {
  if (!on_surface_) on_surface_ = std::make_unique<const space::Result>(*before_, *after_);
  return *on_surface_;
}

}  // namespace qmorph
