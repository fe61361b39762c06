// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/predicates.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace qmorph {
namespace {

/// A sum of doubles that is exact: components that do not overlap, smallest first.
class ExactSum {
 public:
  void add(double value) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = value + parts_[i];
      const double rounded = sum - value;
      const double error = (value - (sum - rounded)) + (parts_[i] - rounded);
      if (error != 0) parts_[kept++] = error;
      value = sum;
    }
    if (value != 0 || kept == 0) parts_[kept++] = value;  // the last part alone decides the sign
    size_ = kept;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  int sign() const {
    const double leading = parts_[size_ - 1];
    return (leading > 0) - (leading < 0);
  }

 private:
  std::array<double, 16> parts_{};
  std::size_t size_ = 0;
};

int exact_orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  ExactSum sum;
  sum.add_product(a.x(), b.y());
  sum.add_product(-a.y(), b.x());
  sum.add_product(b.x(), c.y());
  sum.add_product(-b.y(), c.x());
  sum.add_product(c.x(), a.y());
  sum.add_product(-c.y(), a.x());
  return sum.sign();
}

}  // namespace

int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  // Error bound of the straightforward determinant, [Shewchuk97] section 4.
  constexpr double kRound = std::numeric_limits<double>::epsilon() / 2;
  constexpr double kErrorBound = (3 + 16 * kRound) * kRound;
  const double left = (a.x() - c.x()) * (b.y() - c.y());
  const double right = (a.y() - c.y()) * (b.x() - c.x());
  const double determinant = left - right;
  const double bound = kErrorBound * (std::abs(left) + std::abs(right));
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  return exact_orientation(a, b, c);
}

}  // namespace qmorph
