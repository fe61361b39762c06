// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/describe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace qmorph {

std::string describe(const Eigen::Vector3d& p) {
  constexpr int kDigits = 6;
  const double largest = p.cwiseAbs().maxCoeff();
  const int places = largest >= 1 && std::isfinite(largest) ? int(std::floor(std::log10(largest))) : 0;
  const double last_place = largest < 1 ? largest * std::pow(10, -kDigits) : std::pow(10, -kDigits);
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(std::min(kDigits + places, std::numeric_limits<double>::max_digits10));
  const auto shown = [&](double x) { return std::abs(x) < last_place / 2 ? 0.0 : x; };
  text << '(' << shown(p.x()) << ", " << shown(p.y()) << ", " << shown(p.z()) << ')';
  return text.str();
}

}  // namespace qmorph
