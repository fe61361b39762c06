// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/relax_flat.hpp"

namespace qmorph::chart {
namespace {

/// Values of the matrix, as multiples of its diagonal: what belongs to those above the first is made small. Waves of a
/// dozen edges have that one. None is larger than the second: of a single triangle the values are 0 and two that make 3
/// in all, whatever its shape, and those of all triangles together are no larger.
constexpr double kLeastValue = 0.06, kLargestValue = 3;
constexpr int kSteps = 12;

class Relaxation {
 public:
  Relaxation(const space::Background& surface, std::span<const Shape> shapes, std::vector<Vec2>& points)
      : surface_(surface), shapes_(shapes), points_(points), inverse_(points.size(), 0), pull_(points.size()) {
    weights_.reserve(3 * shapes.size());
    for (Index t = 0; t < shapes.size(); ++t)
      for (int i = 0; i < 3; ++i) {
        weights_.push_back(0.5 * shapes[t].cotangent(i));
        for (Index v : {surface.corners(t)[i], surface.corners(t)[(i + 1) % 3]}) inverse_[v] += weights_.back();
      }
  }

  void run() {
    for (double& value : inverse_) value = value > 0 ? 1 / value : 0;
    constexpr double kMiddle = (kLargestValue + kLeastValue) / 2, kHalf = (kLargestValue - kLeastValue) / 2;
    std::vector<Vec2> step(points_.size(), Vec2::Zero());
    double ratio = kHalf / kMiddle, last = 0;
    for (int k = 0; k < kSteps; ++k) {
      find_pulls();
      const double keep = k == 0 ? 0 : ratio * last, add = k == 0 ? 1 / kMiddle : 2 * ratio / kHalf;
      for (std::size_t v = 0; v < points_.size(); ++v) {
        step[v] = keep * step[v] + add * inverse_[v] * pull_[v];
        points_[v] += step[v];
      }
      last = ratio;
      ratio = 1 / (2 * kMiddle / kHalf - ratio);
    }
  }

 private:
  void find_pulls() {
    std::fill(pull_.begin(), pull_.end(), Vec2::Zero());
    for (Index t = 0; t < shapes_.size(); ++t) {
      const Complex turn = map_of(surface_, shapes_[t], t, points_).rotation();
      const auto& corners = surface_.corners(t);
      for (int i = 0; i < 3; ++i) {
        const Index a = corners[i], b = corners[(i + 1) % 3];
        const Complex side = product(turn, shapes_[t].side(i));
        const Vec2 pull = weights_[3 * t + i] * (Vec2(side.real(), side.imag()) - (points_[b] - points_[a]));
        pull_[b] += pull;
        pull_[a] -= pull;
      }
    }
  }

  const space::Background& surface_;
  const std::span<const Shape> shapes_;
  std::vector<Vec2>& points_;
  std::vector<double> weights_;  ///< by side
  std::vector<double> inverse_;  ///< of the diagonal, by point
  std::vector<Vec2> pull_;
};

}  // namespace

void relax_flat(const space::Background& surface, std::span<const Shape> shapes, std::vector<Vec2>& points) {
  Relaxation(surface, shapes, points).run();
}

}  // namespace qmorph::chart
