// SPDX-License-Identifier: GPL-2.0-or-later
#include "bands/lay_blade.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "bands/find_band.hpp"
#include "geometry/predicates.hpp"

namespace qmorph::bands {
namespace {

constexpr std::size_t kMostNodes = 256, kFewestNodes = 6;
constexpr double kSharpest = 45 * std::numbers::pi / 180;
/// The one of two nodes that face each other may be so many edges farther from the corner.
constexpr int kMostAskew = 12;
/// A row is as wide as so many edges of the sides are long, at most.
constexpr double kWidest = 1.7;
/// The nodes inside a rung may lie ahead of it, or behind: by so much of half an edge of the sides, and of the rung.
constexpr double kShift = 0.6, kShiftAcross = 0.8;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A line of nodes across, from node i of the one side to node j of the other, both counted from the corner.
struct Rung {
  int i = 0, j = 0;
  int rows = 0;         ///< 0 in a corner, where both sides are at the same node
  int shift = 0;        ///< -1, 0, 1: of the nodes between
  bool is_end = false;  ///< the other end of the region: nodes between are its boundary's
};

/// How a rung follows another: which of its sides has gone on.
enum class Step { both, first, second };

/// A node of one of two rungs that follow each other.
struct Ref {
  bool of_next;
  int k;
};
using Faces = std::vector<std::array<Ref, 4>>;

/// The quads between two rungs; where only one side goes on, there is a row more or less.
Faces faces_between(int rows, int next_rows, Step step) {
  Faces faces;
  if (rows == 0) return {{{Ref{true, 0}, Ref{true, 1}, Ref{true, 2}, Ref{false, 0}}}};
  if (next_rows == 0) return {{{Ref{false, 1}, Ref{false, 0}, Ref{true, 0}, Ref{false, 2}}}};
  for (int k = 0; k < std::min(rows, next_rows); ++k) {
    const int own = step == Step::second && next_rows < rows ? k + 1 : k;
    const int other = step == Step::second && next_rows > rows ? k + 1 : k;
    faces.push_back({Ref{false, own}, Ref{true, other}, Ref{true, other + 1}, Ref{false, own + 1}});
  }
  return faces;
}

class BladePlanner {
 public:
  /// `polygon`: counter-clockwise, the corner first.
  explicit BladePlanner(std::vector<Vec2> polygon)
      : p_(std::move(polygon)), n_(int(p_.size())), best_(std::size_t(n_ * kAskew * kKinds)) {}

  /// From the corner to the other end; empty if there is no way.
  std::vector<Rung> run() {
    go({}, 0);
    for (int sum = 2; sum < n_; ++sum)
      for (int i = std::max(1, (sum - kMostAskew + 1) / 2); i < sum && 2 * i <= sum + kMostAskew; ++i)
        for (int kind = 0; kind < kKinds; ++kind) {
          const Rung rung = rung_of(i, sum - i, kind);
          if (const double cost = best(rung).cost; cost < end_cost_) go(rung, cost);
        }
    std::vector<Rung> rungs;
    if (end_cost_ == kInfinite) return rungs;
    for (Rung at = end_; at.i > 0; at = rungs.size() == 1 ? before_end_ : best(at).before) rungs.push_back(at);
    rungs.push_back({});
    std::reverse(rungs.begin(), rungs.end());
    return rungs;
  }

  /// Rows of the polygon's nodes.
  int first(int i) const { return i; }
  int second(int j) const { return (n_ - j) % n_; }

  /// Of the k-th node of a rung.
  Vec2 place(const Rung& r, int k) const {
    if (k == 0) return p_[std::size_t(first(r.i))];
    if (k == r.rows) return p_[std::size_t(second(r.j))];
    if (r.is_end) return p_[std::size_t(r.i + k)];
    const Vec2 from = p_[std::size_t(first(r.i))], across = p_[std::size_t(second(r.j))] - from;
    const Vec2 ahead = half_ahead(r);
    const double length = std::min(kShift * ahead.norm(), kShiftAcross * across.norm());
    return from + double(k) / r.rows * across + r.shift * length * ahead.normalized();
  }

  std::size_t looks() const { return looks_; }

 private:
  static constexpr int kMostShift = 1, kShifts = 3, kKinds = 1 + kShifts * (kMostRows - 1), kAskew = 2 * kMostAskew + 1;

  struct Way {
    double cost = kInfinite;
    Rung before{};
  };

  static Rung rung_of(int i, int j, int kind) {
    if (kind == 0) return {i, j, 1, 0};
    return {i, j, 2 + (kind - 1) / kShifts, (kind - 1) % kShifts - kMostShift};
  }
  Way& best(const Rung& r) {
    const int kind = r.rows == 1 ? 0 : 1 + (r.rows - 2) * kShifts + r.shift + kMostShift;
    return best_[std::size_t((r.i * kAskew + r.j - r.i + kMostAskew) * kKinds + kind)];
  }

  /// Half of the way from the nodes before to those behind.
  Vec2 half_ahead(const Rung& r) const {
    const Vec2 next = p_[std::size_t(first(r.i + 1))] + p_[std::size_t(second(r.j + 1))];
    return 0.25 * (next - p_[std::size_t(first(r.i - 1))] - p_[std::size_t(second(r.j - 1))]);
  }

  bool is_too_wide(const Rung& r) const {
    const double width = (place(r, r.rows) - place(r, 0)).norm();
    return r.rows > 0 && !r.is_end && width > kWidest * r.rows * 2 * half_ahead(r).norm();
  }

  void go(const Rung& from, double cost) {
    if (from.rows == 0) {
      step(from, {1, 1, 2, 0}, Step::both, cost);
      return;
    }
    step(from, {from.i + 1, from.j + 1, from.rows, 0}, Step::both, cost);
    if (from.rows == 2 && from.i + from.j + 2 == n_) step(from, {from.i + 1, from.j + 1, 0, 0}, Step::both, cost);
    for (int rows : {from.rows - 1, from.rows + 1})
      if (rows >= 1 && rows <= kMostRows) {
        step(from, {from.i + 1, from.j, rows, 0}, Step::first, cost);
        step(from, {from.i, from.j + 1, rows, 0}, Step::second, cost);
      }
  }

  /// With all shifts of the next rung, or as the end. Before a corner it may be either.
  void step(const Rung& from, Rung to, Step how, double cost) {
    const int left = n_ - to.rows - to.i - to.j;
    if (left < 0) return;
    const Faces faces = faces_between(from.rows, to.rows, how);
    const auto price_all = [&] {
      double sum = cost;
      for (const auto& face : faces) sum += price(from, to, face);
      return sum;
    };
    if (left == 0) {
      to.is_end = true;
      if (const double sum = price_all(); sum < end_cost_) end_cost_ = sum, end_ = to, before_end_ = from;
      to.is_end = false;
    }
    if ((left == 0 && to.rows != 2) || std::abs(to.i - to.j) > kMostAskew || is_too_wide(to)) return;
    const int most = to.rows > 1 ? kMostShift : 0;
    for (to.shift = -most; to.shift <= most; ++to.shift)
      if (const double sum = price_all(); sum < best(to).cost) best(to) = {sum, from};
  }

  double price(const Rung& from, const Rung& to, const std::array<Ref, 4>& face) {
    ++looks_;
    std::array<Vec2, 4> q;
    for (std::size_t c = 0; c < 4; ++c) q[c] = place(face[c].of_next ? to : from, face[c].k);
    const double sine = smallest_corner_sine(q[0], q[1], q[2], q[3]);
    return sine > kStraightSine ? 1 / sine : kInfinite;
  }

  const std::vector<Vec2> p_;
  const int n_;
  std::vector<Way> best_;
  double end_cost_ = kInfinite;
  Rung end_{}, before_end_{};
  std::size_t looks_ = 0;
};

/// The loop from its sharpest corner on; empty if that is not sharp.
Loop from_sharpest_corner(Loop loop, const std::vector<Vec2>& points) {
  std::size_t sharpest = 0;
  double least = kSharpest;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 at = points[loop[i]];
    const double angle =
        ccw_angle(points[loop[(i + 1) % loop.size()]] - at, points[loop[(i + loop.size() - 1) % loop.size()]] - at);
    if (angle > 0 && angle < least) least = angle, sharpest = i;
  }
  if (least == kSharpest) return {};
  std::rotate(loop.begin(), loop.begin() + std::ptrdiff_t(sharpest), loop.end());
  return loop;
}

kernel::Mesh mesh_of(const BladePlanner& planner, const std::vector<Rung>& rungs, const Loop& loop,
                     const std::vector<Vec2>& region_points) {
  std::vector<Vec2> points = region_points;
  std::vector<std::vector<Index>> nodes;
  for (const Rung& r : rungs) {
    std::vector<Index> across{loop[std::size_t(planner.first(r.i))]};
    for (int k = 1; k < r.rows; ++k) {
      if (r.is_end) {
        across.push_back(loop[std::size_t(r.i + k)]);
        continue;
      }
      across.push_back(Index(points.size()));
      points.push_back(planner.place(r, k));
    }
    if (r.rows > 0) across.push_back(loop[std::size_t(planner.second(r.j))]);
    nodes.push_back(std::move(across));
  }
  std::vector<std::array<Index, 4>> faces;
  for (std::size_t k = 0; k + 1 < rungs.size(); ++k) {
    const Rung &from = rungs[k], &to = rungs[k + 1];
    const Step step = to.i == from.i ? Step::second : to.j == from.j ? Step::first : Step::both;
    for (const auto& face : faces_between(from.rows, to.rows, step)) {
      faces.emplace_back();
      for (std::size_t c = 0; c < 4; ++c) faces.back()[c] = nodes[face[c].of_next ? k + 1 : k][std::size_t(face[c].k)];
    }
  }
  return kernel::Mesh(points, faces, {});
}

}  // namespace

std::optional<kernel::Mesh> lay_blade(const Region& region) {
  const std::size_t n = region.boundary_sides;
  if (n < kFewestNodes || n > kMostNodes || n % 2 != 0) return {};
  std::vector<Loop> loops = boundary_of(region);
  if (loops.size() != 1 || loops[0].size() != n) return {};
  for (Index v : region.fixed)
    if (std::find(loops[0].begin(), loops[0].end(), v) == loops[0].end()) return {};
  const Loop loop = from_sharpest_corner(std::move(loops[0]), region.points);
  if (loop.empty()) return {};
  std::vector<Vec2> polygon;
  for (Index v : loop) polygon.push_back(region.points[v]);
  BladePlanner planner(std::move(polygon));
  const std::vector<Rung> rungs = planner.run();
  if (rungs.empty()) return {};
  kernel::Mesh mesh = mesh_of(planner, rungs, loop, region.points);
  mesh.add_work(planner.looks());
  return mesh;
}

}  // namespace qmorph::bands
