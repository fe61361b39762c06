// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/flatten.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <limits>
#include <utility>

#include "chart/flat_shape.hpp"
#include "chart/relax_flat.hpp"
#include "chart/turn_back.hpp"

namespace qmorph::chart {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Rounds end when one lowers the energy by less than this share of it.
constexpr double kLeastGain = 0.02;
/// With less energy than this per triangle, which is a thousandth of its lengths, the surface unrolls and a round is
/// not worth the time.
constexpr double kFlatEnough = 1e-6;
/// Over-relaxation: points move this many times as far as a round takes them, so that fewer rounds are needed.
constexpr double kOvershoot = 1.7;
/// A triangle with a smaller sine is as bad as one that is turned over.
constexpr double kLeastSine = 1e-4;
/// Distortions are no larger than the inverse of this.
constexpr double kFlat = 1e-3;

/// By the lengths of its sides.
Shape shape_with(std::span<const double, 3> sides) {
  const auto [ab, bc, ca] = std::array{sides[0], sides[1], sides[2]};
  const double longest = std::max({ab, bc, ca});
  Shape shape;
  shape.base = std::max(ab, kLeastHeight * longest);
  const double along = (shape.base * shape.base + ca * ca - bc * bc) / (2 * shape.base);
  const double height2 = ca * ca - along * along;
  shape.tip = {along, std::max(height2 > 0 ? std::sqrt(height2) : 0, kLeastHeight * longest)};
  return shape;
}

std::vector<Shape> shapes_of(const space::Background& surface, std::span<const double> lengths) {
  std::vector<Shape> shapes;
  shapes.reserve(surface.triangles());
  for (Index t = 0; t < surface.triangles(); ++t)
    shapes.push_back(lengths.empty() ? shape_of(surface, t) : shape_with(lengths.subspan(3 * t).first<3>()));
  return shapes;
}

/// Whether all sines are larger than kLeastSine.
bool is_upright(const space::Background& surface, Index t, const std::vector<Vec2>& points) {
  const Vec2 &a = points[surface.corners(t)[0]], &b = points[surface.corners(t)[1]], &c = points[surface.corners(t)[2]];
  const double longest2 = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  if (cross(b - a, c - a) > 2 * kLeastSine * longest2) return true;  // no need to look closer
  return std::min({corner_sine(a, b, c), corner_sine(b, c, a), corner_sine(c, a, b)}) >= kLeastSine;
}

class Flattening2D {
 public:
  Flattening2D(const space::Background& surface, std::vector<Shape> shapes, std::size_t points)
      : surface_(surface), shapes_(std::move(shapes)), points_(points, Vec2::Zero()) {
    scale();
    unfold();
    factorise();
  }

  /// All points at one place if numbers are too small for more.
  std::vector<Vec2> run(int rounds) {
    if (solver_.info() != Eigen::Success) return std::move(points_);
    solve();
    double energy = turn();
    for (int round = energy > kFlatEnough * double(shapes_.size()) ? 1 : rounds; round < rounds; ++round) {
      const std::vector<Vec2> before = points_;
      solve();
      for (std::size_t v = 0; v < points_.size(); ++v) points_[v] = before[v] + kOvershoot * (points_[v] - before[v]);
      const double now = turn();
      if (!(now < (1 - kLeastGain) * energy)) break;
      energy = now;
    }
    if (energy > kFlatEnough * double(shapes_.size())) solve();
    for (Vec2& p : points_) p *= unit_;
    return std::move(points_);
  }

 private:
  /// Lengths in units of a usual side, so that nothing is too large or too small to compute with.
  void scale() {
    double area = 0;
    for (const Shape& shape : shapes_) area += shape.area();
    unit_ = area > 0 ? std::sqrt(area / double(shapes_.size())) : 1;
    for (Shape& shape : shapes_) shape.base /= unit_, shape.tip /= unit_;
  }

  void factorise() {
    std::vector<double> weights, diagonal(points_.size(), 0);  // by side and by point
    weights.reserve(3 * shapes_.size()), pulls_.reserve(3 * shapes_.size());
    for (Index t = 0; t < shapes_.size(); ++t)
      for (int i = 0; i < 3; ++i) {
        const double weight = 0.5 * shapes_[t].cotangent(i);
        weights.push_back(weight);
        for (Index v : {surface_.corners(t)[i], surface_.corners(t)[(i + 1) % 3]}) diagonal[v] += weight;
        const Complex pull = weight * shapes_[t].side(i);
        pulls_.emplace_back(pull.real(), pull.imag());
      }
    for (Index t : first_) diagonal[surface_.corners(t)[0]] += 1;  // holds one point
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(points_.size() + 2 * shapes_.size());
    for (Index v = 0; v < points_.size(); ++v) entries.emplace_back(int(v), int(v), diagonal[v]);
    for (Index side = 0; side < weights.size(); ++side) {
      const Index other = surface_.opposite(side);
      if (other != kNone && other < side) continue;
      const double weight = weights[side] + (other == kNone ? 0 : weights[other]);
      const auto [low, high] =
          std::minmax(surface_.corners(side / 3)[side % 3], surface_.corners(side / 3)[(side + 1) % 3]);
      entries.emplace_back(int(high), int(low), -weight);
    }
    Matrix matrix(Eigen::Index(points_.size()), Eigen::Index(points_.size()));
    matrix.setFromTriplets(entries.begin(), entries.end());
    solver_.compute(matrix);
  }

  /// The triangle that is reached last from the boundary.
  Index middle() const {
    std::vector<Index> order;
    std::vector<char> seen(shapes_.size(), 0);
    const auto reach = [&](Index t) {
      if (!seen[t]) seen[t] = 1, order.push_back(t);
    };
    for (Index side = 0; side < 3 * shapes_.size(); ++side)
      if (surface_.opposite(side) == kNone) reach(side / 3);
    for (std::size_t k = 0; k < order.size(); ++k)
      for (int i = 0; i < 3; ++i)
        if (const Index other = surface_.neighbour(order[k], i); other != kNone) reach(other);
    return order.empty() ? 0 : order.back();
  }

  /// Rotations that lay each triangle beside the one that it is reached from, the middle first.
  void unfold() {
    rotations_.assign(shapes_.size(), Complex(0));
    unfold_from(middle());
    for (Index t = 0; t < shapes_.size(); ++t)
      if (rotations_[t] == Complex(0)) unfold_from(t);
  }

  void unfold_from(Index first) {
    if (first >= shapes_.size()) return;
    first_.push_back(first);
    std::vector<Index> order{first};
    rotations_[first] = 1;
    for (std::size_t k = 0; k < order.size(); ++k) {
      const Index t = order[k];
      for (Index side = 3 * t; side < 3 * t + 3; ++side) {
        const Index other = surface_.opposite(side);
        if (other == kNone || rotations_[other / 3] != Complex(0)) continue;
        const Complex turned =
            product(product(rotations_[t], shapes_[t].side(side % 3)), -std::conj(shapes_[other / 3].side(other % 3)));
        rotations_[other / 3] = turned / Map::size(turned);
        order.push_back(other / 3);
      }
    }
  }

  /// Points for the rotations.
  void solve() {
    std::vector<Vec2> right(points_.size(), Vec2::Zero());
    for (Index t = 0; t < shapes_.size(); ++t) {
      const Vec2 turn(rotations_[t].real(), rotations_[t].imag());
      const auto& corners = surface_.corners(t);
      for (int i = 0; i < 3; ++i) {
        const Vec2& pull = pulls_[3 * t + i];
        const Vec2 turned(turn.x() * pull.x() - turn.y() * pull.y(), turn.x() * pull.y() + turn.y() * pull.x());
        right[corners[(i + 1) % 3]] += turned;
        right[corners[i]] -= turned;
      }
    }
    substitute(right);
  }

  /// Both coordinates at a time: it is the memory of the factor that takes the time.
  void substitute(const std::vector<Vec2>& right) {
    const auto& order = solver_.permutationP().indices();
    const auto& factor = solver_.matrixL().nestedExpression();
    const auto& diagonal = solver_.vectorD();
    std::vector<Vec2> x(right.size());
    for (std::size_t v = 0; v < right.size(); ++v) x[order[Eigen::Index(v)]] = right[v];
    const Eigen::Index n = factor.cols();
    for (Eigen::Index column = 0; column < n; ++column)
      for (Matrix::InnerIterator at(factor, column); at; ++at)
        if (at.row() > column) x[at.row()] -= at.value() * x[column];
    for (Eigen::Index column = n; column-- > 0;) {
      Vec2 value = x[column] / diagonal[column];
      for (Matrix::InnerIterator at(factor, column); at; ++at)
        if (at.row() > column) value -= at.value() * x[at.row()];
      x[column] = value;
    }
    for (std::size_t v = 0; v < right.size(); ++v) points_[v] = x[order[Eigen::Index(v)]];
  }

  /// Rotations for the points. Returns what is left between the two.
  double turn() {
    double energy = 0;
    for (Index t = 0; t < shapes_.size(); ++t) {
      const Map map = map_of(surface_, shapes_[t], t, points_);
      rotations_[t] = map.rotation();
      const double off = Map::size(map.a) - 1;
      energy += shapes_[t].area() * (off * off + std::norm(map.b));
    }
    return energy;
  }

  const space::Background& surface_;
  std::vector<Shape> shapes_;
  double unit_ = 1;
  std::vector<Vec2> points_;
  std::vector<Complex> rotations_;
  std::vector<Index> first_;  ///< a triangle of each part that hangs together
  std::vector<Vec2> pulls_;   ///< by side: what it adds to the right hand side before it is turned
  Eigen::SimplicialLDLT<Matrix> solver_;
};

void measure_distortion(const space::Background& surface, const std::vector<Shape>& shapes, Flattening& flattening) {
  std::vector<double> ratios{1}, factors{1};
  ratios.reserve(surface.triangles() + 1), factors.reserve(surface.triangles() + 1);
  flattening.flipped = 0;
  for (Index t = 0; t < surface.triangles(); ++t) {
    const Shape& shape = shapes[t];
    const Map map = map_of(surface, shape, t, flattening.points);
    const double larger = map.larger(), smaller = std::max(map.smaller(), kFlat * larger);
    flattening.flipped += !is_upright(surface, t, flattening.points);
    if (shape.tip.imag() <= 1.5 * kLeastHeight * std::abs(shape.tip)) continue;  // has no shape to compare with
    ratios.push_back(larger / smaller);
    factors.push_back(std::max(larger, 1 / smaller));
  }
  const auto high = [](std::vector<double>& values) {
    const auto at = values.begin() + std::ptrdiff_t(0.99 * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
  };
  flattening.distortion = high(ratios);
  flattening.scaling = high(factors);
}

}  // namespace

Flattening flatten(const space::Background& surface, std::size_t points, int rounds, std::span<const double> lengths) {
  const std::vector<Shape> shapes = shapes_of(surface, lengths);
  Flattening flattening;
  flattening.points = Flattening2D(surface, shapes, points).run(rounds);
  measure_distortion(surface, shapes, flattening);
  if (flattening.flipped > 0 && turn_back(surface, flattening.points, flattening.work))
    measure_distortion(surface, shapes, flattening);
  return flattening;
}

std::optional<Flattening> flatten_from(const space::Background& surface, std::vector<Vec2> start) {
  const std::vector<Shape> shapes = shapes_of(surface, {});
  Flattening flattening;
  flattening.points = std::move(start);
  relax_flat(surface, shapes, flattening.points);
  measure_distortion(surface, shapes, flattening);
  if (flattening.flipped > 0) return {};
  return flattening;
}

}  // namespace qmorph::chart
