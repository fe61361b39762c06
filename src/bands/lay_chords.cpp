// SPDX-License-Identifier: GPL-2.0-or-later
#include "bands/lay_chords.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "bands/find_band.hpp"
#include "geometry/predicates.hpp"

namespace qmorph::bands {
namespace {

constexpr std::size_t kMostNodes = 48, kFewestNodes = 4;
/// Nodes inside, for each of the boundary, that a region may have had.
constexpr double kMostInside = 0.25;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The part of the polygon from node `from` on to node `to`, closed by the chord between them, is best cut there: into
/// the face that has the chord, and up to three smaller parts.
struct Cut {
  double cost = kInfinite;
  std::size_t second = 0, third = 0;  ///< the face's other corners; of a triangle the same twice
};

class ChordPlanner {
 public:
  explicit ChordPlanner(std::vector<Vec2> polygon) : p_(std::move(polygon)), best_(p_.size() * p_.size()) {}

  /// Rows of nodes of the polygon; empty if there is no way.
  std::vector<std::array<Index, 4>> run() {
    const std::size_t n = p_.size();
    for (std::size_t i = 0; i + 1 < n; ++i) best(i, i + 1).cost = 0;
    for (std::size_t length = 2; length < n; ++length) {
      if (length % 2 == 0 && n % 2 == 0) continue;  // would leave a triangle
      for (std::size_t i = 0; i + length < n; ++i) cut(i, i + length);
    }
    if (best(0, n - 1).cost == kInfinite) return {};
    take(0, n - 1);
    return std::move(faces_);
  }

  std::size_t looks() const { return looks_; }

 private:
  Cut& best(std::size_t i, std::size_t j) { return best_[i * p_.size() + j]; }

  void cut(std::size_t i, std::size_t j) {
    Cut& here = best(i, j);
    const bool is_even = (j - i) % 2 == 1;  // with the chord
    for (std::size_t k = i + 1; k < j; ++k) {
      const double first = best(i, k).cost;
      if (first >= here.cost) continue;
      if (!is_even && (k - i) % 2 == 1) consider(here, first + best(k, j).cost, i, k, k, j);
      for (std::size_t l = k + 1; l < j; ++l) {
        // Of three parts one may have a triangle, if the whole has.
        const int odd = int((k - i + 1) % 2 + (l - k + 1) % 2 + (j - l + 1) % 2);
        if (odd == (is_even ? 0 : 1)) consider(here, first + best(k, l).cost + best(l, j).cost, i, k, l, j);
      }
    }
  }

  void consider(Cut& here, double parts, std::size_t i, std::size_t k, std::size_t l, std::size_t j) {
    if (parts >= here.cost) return;
    ++looks_;
    const double cost = parts + (k == l ? price(p_[i], p_[k], p_[j]) : price(p_[i], p_[k], p_[l], p_[j]));
    if (cost < here.cost) here = {cost, k, l};
  }

  static double price(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const double sine = smallest_corner_sine(a, b, c, d);
    return sine > kStraightSine ? 1 / sine : kInfinite;
  }

  /// A sharp triangle is no worse than others: nobody asks it for right angles.
  static double price(const Vec2& a, const Vec2& b, const Vec2& c) {
    return is_triangle_above(a, b, c, kStraightSine) ? 1 : kInfinite;
  }

  void take(std::size_t i, std::size_t j) {
    if (j == i + 1) return;
    const auto [cost, k, l] = best(i, j);
    faces_.push_back({Index(i), Index(k), Index(l), Index(j)});
    if (k == l) faces_.back() = {Index(i), Index(k), Index(j), kNone};
    take(i, k), take(l, j);
    if (k != l) take(k, l);
  }

  const std::vector<Vec2> p_;
  std::vector<Cut> best_;
  std::vector<std::array<Index, 4>> faces_;
  std::size_t looks_ = 0;
};

}  // namespace

Chords best_chords(std::vector<Vec2> polygon) {
  ChordPlanner planner(std::move(polygon));
  Chords chords{planner.run()};
  chords.looks = planner.looks();
  return chords;
}

std::optional<kernel::Mesh> lay_chords(const Region& region) {
  if (region.boundary_sides < kFewestNodes || region.boundary_sides > kMostNodes) return {};
  const std::vector<Loop> loops = boundary_of(region);
  if (loops.size() != 1 || loops[0].size() != region.boundary_sides) return {};
  const std::size_t inside = (region.triangles.size() + 2 - region.boundary_sides) / 2;  // by Euler's formula
  if (double(inside) > kMostInside * double(region.boundary_sides)) return {};
  for (Index v : region.fixed)
    if (std::find(loops[0].begin(), loops[0].end(), v) == loops[0].end()) return {};
  std::vector<Vec2> polygon;
  for (Index v : loops[0]) polygon.push_back(region.points[v]);
  Chords chords = best_chords(std::move(polygon));
  if (chords.faces.empty()) return {};
  for (auto& face : chords.faces)
    for (Index& v : face)
      if (v != kNone) v = loops[0][v];
  kernel::Mesh mesh(region.points, chords.faces, {});
  mesh.add_work(chords.looks);
  return mesh;
}

}  // namespace qmorph::bands
