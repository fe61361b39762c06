// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/describe.hpp"

#include <sstream>

namespace qmorph {

std::string describe(const Eigen::Vector3d& p) {
  std::ostringstream text;
  text.precision(6);
  text << '(' << p.x() << ", " << p.y() << ", " << p.z() << ')';
  return text.str();
}

}  // namespace qmorph
