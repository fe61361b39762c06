// SPDX-License-Identifier: GPL-2.0-or-later
#include "stretch/flat_lengths.hpp"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "kernel/loops.hpp"

namespace qmorph::stretch {
namespace {

using space::Background;
using Matrix = Eigen::SparseMatrix<double>;
constexpr double kPi = std::numbers::pi;

/// Steps of Newton's method, each of which squares what is amiss when that is small.
constexpr int kMostSteps = 8, kHalvings = 5;
/// Angles around a node that are off a full turn by less, in the mean, are as good as flat.
constexpr double kFlatEnough = 1e-3;

/// The boundary's loops, as nodes.
std::vector<std::vector<Index>> loops_of(const Background& surface) {
  std::vector<Index> next(surface.points().size(), kNone);
  for (Index side = 0; side < 3 * surface.triangles(); ++side)
    if (surface.opposite(side) == kNone)
      next[surface.corners(side / 3)[side % 3]] = surface.corners(side / 3)[(side + 1) % 3];
  return kernel::follow_loops(std::move(next));
}

/// Angles and the cotangents' halves of a triangle by its sides: of the corner across each. One that is no triangle has
/// angles of 180 and 0 degrees.
struct Corners {
  std::array<double, 3> angles{}, weights{};

  explicit Corners(const std::array<double, 3>& sides) {
    const double perimeter = sides[0] + sides[1] + sides[2];
    for (std::size_t i = 0; i < 3; ++i) {
      const double a = sides[i], b = sides[(i + 1) % 3], c = sides[(i + 2) % 3];
      const double near = perimeter - 2 * a, far = perimeter * near, across = (perimeter - 2 * b) * (perimeter - 2 * c);
      if (!(near > 0)) angles[i] = kPi;
      if (!(far > 0 && across > 0)) continue;
      angles[i] = 2 * std::atan2(std::sqrt(across), std::sqrt(far));
      weights[i] = 0.5 * (far - across) / (2 * std::sqrt(far * across));
    }
  }
};

class Flattening {
 public:
  Flattening(const Background& surface, std::vector<double> lengths)
      : surface_(surface), lengths_(std::move(lengths)), loops_(loops_of(surface)) {}

  std::vector<double> run() {
    if (!is_disc_with_holes()) return {};
    number();
    logs_.assign(unknowns_, 0);
    Eigen::VectorXd amiss = excess();
    double size = amiss.cwiseAbs().sum();
    for (int step = 0; step < kMostSteps && size > kFlatEnough * double(unknowns_); ++step) {
      const std::optional<Eigen::VectorXd> way = newton_step(amiss);
      if (!way) return {};
      const Eigen::VectorXd before = Eigen::Map<Eigen::VectorXd>(logs_.data(), Eigen::Index(unknowns_));
      double share = 1;
      for (int i = 0; i <= kHalvings; ++i, share /= 2) {
        Eigen::Map<Eigen::VectorXd>(logs_.data(), Eigen::Index(unknowns_)) = before + share * *way;
        amiss = excess();
        if (amiss.cwiseAbs().sum() < size) break;
      }
      if (!(amiss.cwiseAbs().sum() < size)) {
        Eigen::Map<Eigen::VectorXd>(logs_.data(), Eigen::Index(unknowns_)) = before;
        break;
      }
      size = amiss.cwiseAbs().sum();
    }
    std::vector<double> scaled(lengths_.size());
    for (Index side = 0; side < scaled.size(); ++side) scaled[side] = scaled_length(side);
    return scaled;
  }

 private:
  Index from(Index side) const { return surface_.corners(side / 3)[side % 3]; }
  Index to(Index side) const { return surface_.corners(side / 3)[(side + 1) % 3]; }

  bool is_disc_with_holes() const {
    std::vector<char> used(surface_.points().size(), 0);
    std::size_t twice_edges = 0;
    for (Index side = 0; side < 3 * surface_.triangles(); ++side) {
      used[from(side)] = 1;
      twice_edges += surface_.opposite(side) == kNone ? 2 : 1;
    }
    const auto nodes = std::ptrdiff_t(std::count(used.begin(), used.end(), 1));
    const std::ptrdiff_t characteristic =
        nodes - std::ptrdiff_t(twice_edges / 2) + std::ptrdiff_t(surface_.triangles());
    return !loops_.empty() && characteristic == 2 - std::ptrdiff_t(loops_.size());
  }

  /// By how much the boundary turns to the left along each loop in space: once round, or back.
  std::size_t outer_loop() const {
    std::vector<double> angles(surface_.points().size(), 0);
    for (Index t = 0; t < surface_.triangles(); ++t)
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d& at = surface_.corner(t, i);
        const Eigen::Vector3d a = surface_.corner(t, (i + 1) % 3) - at, b = surface_.corner(t, (i + 2) % 3) - at;
        angles[surface_.corners(t)[std::size_t(i)]] += std::atan2(a.cross(b).norm(), a.dot(b));
      }
    std::vector<double> turns;
    for (const auto& loop : loops_) {
      turns.push_back(0);
      for (Index v : loop) turns.back() += kPi - angles[v];
    }
    return std::size_t(std::max_element(turns.begin(), turns.end()) - turns.begin());
  }

  /// Each inner node has an unknown, and each hole; the outer boundary has none.
  void number() {
    unknown_.assign(surface_.points().size(), kNone);
    std::vector<char> is_used(unknown_.size(), 0);
    for (Index side = 0; side < 3 * surface_.triangles(); ++side) is_used[from(side)] = 1;
    const std::size_t outer = outer_loop();
    std::vector<char> is_boundary(unknown_.size(), 0);
    for (const auto& loop : loops_)
      for (Index v : loop) is_boundary[v] = 1;
    for (Index v = 0; v < unknown_.size(); ++v)
      if (is_used[v] && !is_boundary[v]) unknown_[v] = unknowns_++;
    inner_ = unknowns_;
    for (std::size_t k = 0; k < loops_.size(); ++k) {
      if (k == outer) continue;
      for (Index v : loops_[k]) unknown_[v] = unknowns_;
      straight_.push_back(kPi * double(loops_[k].size()));
      ++unknowns_;
    }
  }

  double log_at(Index v) const { return unknown_[v] == kNone ? 0 : logs_[unknown_[v]]; }
  double scaled_length(Index side) const {
    return lengths_[side] * std::exp(0.5 * (log_at(from(side)) + log_at(to(side))));
  }
  Corners corners(Index t) const {
    return Corners({scaled_length(3 * t), scaled_length(3 * t + 1), scaled_length(3 * t + 2)});
  }
  /// The node across a side.
  Index across(Index t, Index i) const { return surface_.corners(t)[(i + 2) % 3]; }

  /// What the angles lack at each unknown.
  Eigen::VectorXd excess() const {
    Eigen::VectorXd sum(unknowns_);
    for (Index k = 0; k < unknowns_; ++k) sum[k] = k < inner_ ? 2 * kPi : straight_[k - inner_] + 2 * kPi;
    for (Index t = 0; t < surface_.triangles(); ++t) {
      const Corners corner = corners(t);
      for (Index i = 0; i < 3; ++i)
        if (const Index k = unknown_[across(t, i)]; k != kNone) sum[k] -= corner.angles[i];
    }
    return sum;
  }

  std::optional<Eigen::VectorXd> newton_step(const Eigen::VectorXd& amiss) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(9 * surface_.triangles());
    for (Index t = 0; t < surface_.triangles(); ++t) {
      const Corners corner = corners(t);
      for (Index i = 0; i < 3; ++i) {
        const Index p = unknown_[from(3 * t + i)], q = unknown_[to(3 * t + i)];
        if (p == q) continue;
        if (p != kNone) entries.emplace_back(int(p), int(p), corner.weights[i]);
        if (q != kNone) entries.emplace_back(int(q), int(q), corner.weights[i]);
        if (p != kNone && q != kNone)
          entries.emplace_back(int(std::max(p, q)), int(std::min(p, q)), -corner.weights[i]);
      }
    }
    const auto count = Eigen::Index(unknowns_);
    Matrix matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    if (!is_analysed_) solver_.analyzePattern(matrix), is_analysed_ = true;
    solver_.factorize(matrix);
    if (solver_.info() != Eigen::Success) return {};
    Eigen::VectorXd step = solver_.solve(-amiss);
    if (!step.allFinite()) return {};
    return step;
  }

  const Background& surface_;
  const std::vector<double> lengths_;  ///< by side
  const std::vector<std::vector<Index>> loops_;
  std::vector<Index> unknown_;  ///< by node
  Index inner_ = 0, unknowns_ = 0;
  std::vector<double> straight_;  ///< by hole: the angles of a straight line through its nodes
  std::vector<double> logs_;      ///< by unknown, of the factor
  bool is_analysed_ = false;
  Eigen::SimplicialLDLT<Matrix> solver_;
};

}  // namespace

std::vector<double> flat_lengths(const Background& surface, std::vector<double> lengths) {
  return Flattening(surface, std::move(lengths)).run();
}

}  // namespace qmorph::stretch
