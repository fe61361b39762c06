// SPDX-License-Identifier: GPL-2.0-or-later
#include "front/decisions.hpp"

#include <cmath>

namespace qmorph::front {

bool Decisions::would_be_same(const FrontOptions& options) const {
  return seam.contains(options.seam_angle) && seam_many.contains(options.seam_angle_many) &&
         transition.contains(options.transition_ratio) && side_edge.contains(options.side_edge_angle) &&
         corner.contains(signed_square(std::cos(options.corner_angle)));
}

}  // namespace qmorph::front
