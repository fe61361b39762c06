// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/find_layers.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "qmorph/convert.hpp"
#include "qmorph/observer.hpp"
#include "qmorph/quality.hpp"
#include "support/draft.hpp"
#include "support/invariants.hpp"

namespace {

using Eigen::Vector3d;
using qmorph::Index;
using qmorph::Patch;
using Quad = std::array<Index, 4>;

enum class Diagonals { rising, falling, alternating };

/// nx by ny cells, node (i, j) at place(i, j), each cut in two.
Patch grid(Index nx, Index ny, const std::function<Vector3d(Index, Index)>& place,
           Diagonals diagonals = Diagonals::rising) {
  Patch patch;
  for (Index j = 0; j <= ny; ++j)
    for (Index i = 0; i <= nx; ++i) patch.points.push_back(place(i, j));
  for (Index j = 0; j < ny; ++j)
    for (Index i = 0; i < nx; ++i) {
      const Index a = j * (nx + 1) + i, b = a + 1, d = a + nx + 1, c = d + 1;
      const bool falls = diagonals == Diagonals::falling || (diagonals == Diagonals::alternating && (i + j) % 2 == 0);
      if (falls)
        patch.triangles.insert(patch.triangles.end(), {{a, b, d}, {b, c, d}});
      else
        patch.triangles.insert(patch.triangles.end(), {{a, b, c}, {a, c, d}});
    }
  return patch;
}

std::function<Vector3d(Index, Index)> rectangles(double length, double height) {
  return [=](Index i, Index j) { return Vector3d(i * length, j * height, 0); };
}

const double kCreaseAngle = qmorph::Options().crease_angle;

std::size_t layer_quads(const Patch& patch, double crease_angle = kCreaseAngle) {
  const auto layers = qmorph::layers::find_layers(patch, std::vector<bool>(patch.points.size()), crease_angle);
  return layers ? layers->quads : 0;
}

/// The cells of grid(nx, ny) that are quads of layers.
std::size_t whole_cells(const Patch& patch, Index nx, Index ny) {
  const auto layers = qmorph::layers::find_layers(patch, std::vector<bool>(patch.points.size()), kCreaseAngle);
  if (!layers) return 0;
  std::set<Quad> quads;
  for (Quad q : layers->patch.quads) {
    std::sort(q.begin(), q.end());
    quads.insert(q);
  }
  std::size_t count = 0;
  for (Index j = 0; j < ny; ++j)
    for (Index i = 0; i < nx; ++i) {
      const Index a = j * (nx + 1) + i;
      count += quads.contains({a, a + 1, a + nx + 1, a + nx + 2});
    }
  return count;
}

}  // namespace

TEST_CASE("layers: a grid of long rectangles is one, whichever way they are cut") {
  for (const Diagonals diagonals : {Diagonals::rising, Diagonals::falling, Diagonals::alternating})
    for (const double length : {3.0, 10.0, 1e3, 1e6}) {
      CAPTURE(int(diagonals));
      CAPTURE(length);
      CHECK(whole_cells(grid(8, 6, rectangles(length, 1), diagonals), 8, 6) == 48);
      CHECK(whole_cells(grid(8, 6, rectangles(1, length), diagonals), 8, 6) == 48);
    }
}

TEST_CASE("layers: squares and rectangles of 2 to 1 are no layers") {
  for (const Diagonals diagonals : {Diagonals::rising, Diagonals::falling, Diagonals::alternating})
    for (const double length : {0.5, 1.0, 2.0})
      for (const double size : {1.0, 0.1, 1.0 / 3}) {
        CAPTURE(int(diagonals));
        CAPTURE(length);
        CAPTURE(size);
        CHECK(layer_quads(grid(10, 10, rectangles(length * size, size), diagonals)) == 0);
      }
}

TEST_CASE("layers: a grid of long cells may lean by 45 degrees, and one of short cells is no layer") {
  for (const Diagonals diagonals : {Diagonals::rising, Diagonals::falling, Diagonals::alternating})
    for (const double lean : {-1.0, 0.5, 1.0}) {
      const auto leaning = [&](double length) {
        return [=](Index i, Index j) { return Vector3d(length * i + lean * j, j, 0); };
      };
      CAPTURE(int(diagonals));
      CAPTURE(lean);
      CHECK(whole_cells(grid(10, 8, leaning(10), diagonals), 10, 8) == 80);
      CHECK(layer_quads(grid(10, 8, leaning(1), diagonals)) == 0);
    }
}

TEST_CASE("layers: equilateral triangles form none, however they are stretched") {
  for (const double stretch : {1.0, 5.0, 20.0}) {
    const auto place = [&](Index i, Index j) { return Vector3d(stretch * (i + 0.5 * j), 0.87 * j, 0); };
    CHECK(layer_quads(grid(20, 20, place, Diagonals::falling)) == 0);
    CHECK(layer_quads(grid(20, 20, place, Diagonals::rising)) == 0);
  }
}

TEST_CASE("layers: on a curved wall, cells whose diagonal is shorter than a side are found") {
  // Cells of 5 degrees on a circle, so flat that the longest side of many triangles is no diagonal.
  for (const double height : {1e-2, 1e-3, 1e-4, 1e-5})
    for (const double inside : {1.0, -1.0}) {
      const auto place = [&](Index i, Index j) {
        const double angle = -inside * 5 * std::numbers::pi / 180 * i, radius = 1 + inside * height * j;
        return Vector3d(radius * std::cos(angle), radius * std::sin(angle), 0);
      };
      CAPTURE(height);
      CAPTURE(inside);
      for (const Diagonals diagonals : {Diagonals::rising, Diagonals::falling, Diagonals::alternating})
        CHECK(whole_cells(grid(30, 10, place, diagonals), 30, 10) == 300);
    }
}

TEST_CASE("layers: heights may grow, double and differ from column to column") {
  const auto place = [](Index i, Index j) {
    return Vector3d(i, 0.01 * (std::pow(2.0, j) - 1) * (1 + 0.3 * std::sin(i)), 0);
  };
  CHECK(whole_cells(grid(20, 6, place), 20, 6) == 120);
}

TEST_CASE("layers: round a sharp corner without a fan, the last cells of both walls slant to meet") {
  for (const double degrees : {18.0, 9.0, 6.0}) {
    const double half = degrees * std::numbers::pi / 180;  // of the wall's angle
    const auto place = [&](Index i, Index j) {
      const double along = std::abs(double(i) - 4), side = i < 4 ? 1 : -1, height = 0.01 * (std::pow(1.5, j) - 1);
      if (i == 4) return Vector3d(height, 0, 0);
      return Vector3d(-along * std::cos(half) + height * std::sin(half),
                      -side * (along * std::sin(half) + height * std::cos(half)), 0);
    };
    CAPTURE(degrees);
    for (const Diagonals diagonals : {Diagonals::rising, Diagonals::falling, Diagonals::alternating})
      CHECK(whole_cells(grid(8, 6, place, diagonals), 8, 6) == 48);
  }
}

TEST_CASE("layers: where a row ends at another curve, its last cell has the angle between the two, whatever that is") {
  // 10 rows of 0.003 to 0.015, below triangles: the lateral side of the last column lies on the curve.
  constexpr Index kCells = 12, kRows = 10;
  for (const double degrees : {172.0, 150.0, 60.0, 40.0}) {
    const double lean = 1 / std::tan(degrees * std::numbers::pi / 180);
    const auto place = [&](Index i, Index j) {
      const double y = 0.003 * (std::pow(1.2, j) - 1) / 0.2;
      return Vector3d(0.4 * i - (i == kCells ? lean * y : 0), y, 0);
    };
    for (const Diagonals diagonals : {Diagonals::rising, Diagonals::falling}) {
      Patch patch = grid(kCells, kRows, place, diagonals);
      const Index top = kRows * (kCells + 1), left = Index(patch.points.size());
      patch.points.emplace_back(0, 0.6, 0);
      patch.points.emplace_back(patch.points[left - 1].x(), 0.6, 0);
      for (Index i = 0; i < kCells / 2; ++i) patch.triangles.push_back({top + i, top + i + 1, left});
      for (Index i = kCells / 2; i < kCells; ++i) patch.triangles.push_back({top + i, top + i + 1, left + 1});
      patch.triangles.push_back({top + kCells / 2, left + 1, left});
      CAPTURE(degrees);
      CAPTURE(int(diagonals));
      CHECK(whole_cells(patch, kCells, kRows) == kCells * kRows);
    }
  }
}

TEST_CASE("layers: rows of cells that are too short to begin a layer go on round the nose of a wall") {
  // 2.3 times as long as high at the wall, and a little less in each row.
  constexpr double kHalf = 52 * std::numbers::pi / 180;  // of the wall's angle
  const auto place = [](Index i, Index j) {
    const double along = std::abs(double(i) - 12), side = i < 12 ? 1 : -1;
    const double height = (std::pow(1.05, j) - 1) / 0.05 / 2.3;
    if (i == 12) return Vector3d(-height / std::sin(kHalf), 0, 0);
    return Vector3d(along * std::cos(kHalf) - height * std::sin(kHalf),
                    side * (along * std::sin(kHalf) + height * std::cos(kHalf)), 0);
  };
  for (const Diagonals diagonals : {Diagonals::rising, Diagonals::falling, Diagonals::alternating}) {
    CAPTURE(int(diagonals));
    CHECK(whole_cells(grid(24, 5, place, diagonals), 24, 5) == 120);
  }
}

TEST_CASE("layers: a surface in space has its layers, flat or not") {
  const auto place = [](Index i, Index j) { return Vector3d(std::cos(0.1 * i), std::sin(0.1 * i), 0.01 * j); };
  CHECK(whole_cells(grid(40, 8, place), 40, 8) == 320);
}

TEST_CASE("layers: the wall of a cylinder, as CAD programs write it, is a quad for each facet") {
  for (const Index facets : {32, 33, 41}) {  // odd: one column is another
    CAPTURE(facets);
    const double step = 2 * std::numbers::pi / facets;
    Patch patch =
        grid(facets, 1, [&](Index i, Index j) { return Vector3d(std::cos(step * i), std::sin(step * i), 10.0 * j); });
    for (auto& t : patch.triangles)  // the last column of nodes is the first
      for (Index& v : t) v -= v % (facets + 1) == facets ? facets : 0;
    for (const Index lid : {0, 1}) {
      const Index first = lid * (facets + 1), middle = Index(patch.points.size());
      patch.points.emplace_back(0, 0, 10.0 * lid);
      for (Index i = 0; i < facets; ++i) {
        const Index a = first + i, b = first + (i + 1) % facets;
        patch.triangles.push_back(lid ? std::array{middle, a, b} : std::array{middle, b, a});
      }
    }
    CHECK(layer_quads(patch) >= facets - 1);
    CHECK(layer_quads(patch, std::numbers::pi) < facets - 1);  // --crease 180: the rim is no wall
    const qmorph::QuadMesh mesh = qmorph::convert(patch).mesh;
    CHECK(mesh.triangles.empty());
    CHECK(qmorph::measure(mesh).scaled_jacobian_min > 0.7);
  }
}

TEST_CASE("layers: a constraint is a wall on both sides, and no cell crosses it") {
  Patch patch = grid(10, 5, rectangles(10, 1));
  for (Index i = 0; i < 10; ++i) patch.constraints.push_back({2 * 11 + i, 2 * 11 + i + 1});
  CHECK(whole_cells(patch, 10, 5) == 50);
  patch.constraints.push_back({2 * 11 + 4, 3 * 11 + 5});  // a diagonal
  const std::size_t kept = whole_cells(patch, 10, 5);
  CHECK(kept < 50);
  CHECK(kept > 40);
}

TEST_CASE("layers: quads of the input stay first") {
  Patch patch = grid(10, 6, rectangles(10, 1));
  patch.triangles.erase(patch.triangles.begin(), patch.triangles.begin() + 20);
  for (Index i = 0; i < 10; ++i) patch.quads.push_back({i, i + 1, i + 12, i + 11});
  const auto [mesh, report] = qmorph::convert(patch);
  CHECK(report.layer_quads == 50);
  CHECK(mesh.quads.size() == 60);
  const auto broken = qmorph::test::broken_invariants(patch, mesh);
  CHECK_MESSAGE(broken.empty(), broken.front());
}

TEST_CASE(
    "layers: where the wall ends in a sharp corner, an odd number of triangles at the tip cuts one spoke in two") {
  // Rows round a plate of one edge, in spokes of 180 / 3 degrees at both ends, and a ring of other triangles around.
  for (const int spokes : {2, 3, 4, 5}) {
    const Index rows = 6, around = Index(2 * spokes + 2 * 4);
    Patch patch;
    for (int i = 0; i <= 4; ++i) patch.points.emplace_back(i - 2.0, 0, 0);
    std::vector<std::pair<Index, double>> feet;  // of each line, and its direction
    for (Index i = 0; i < 4; ++i) feet.emplace_back(i, std::numbers::pi / 2);
    for (int k = 0; k < spokes; ++k) feet.emplace_back(4, std::numbers::pi * (0.5 - double(k) / spokes));
    for (Index i = 4; i > 0; --i) feet.emplace_back(i, -std::numbers::pi / 2);
    for (int k = 0; k < spokes; ++k) feet.emplace_back(0, std::numbers::pi * (-0.5 - double(k) / spokes));
    REQUIRE(feet.size() == around);
    const auto node = [&](Index line, Index row) {
      return row == 0 ? feet[line % around].first : 5 + (row - 1) * around + line % around;
    };
    for (Index row = 1; row <= rows + 1; ++row)
      for (Index line = 0; line < around; ++line) {
        const double height = row <= rows ? 0.01 * (std::pow(1.6, row) - 1) : 1;
        patch.points.push_back(patch.points[feet[line].first] +
                               height * Vector3d(std::cos(feet[line].second), std::sin(feet[line].second), 0));
      }
    for (Index line = 0; line < around; ++line)
      for (Index row = 0; row <= rows; ++row) {
        const Index a = node(line, row), b = node(line + 1, row), c = node(line + 1, row + 1), d = node(line, row + 1);
        if (row == rows) {  // no row, but four triangles around a node
          const Index m = Index(patch.points.size());
          patch.points.push_back((patch.points[a] + patch.points[b] + patch.points[c] + patch.points[d]) / 4);
          patch.triangles.insert(patch.triangles.end(), {{a, b, m}, {b, c, m}, {c, d, m}, {d, a, m}});
          continue;
        }
        if (a != b) patch.triangles.push_back({a, b, c});
        patch.triangles.push_back({a, c, d});
      }
    for (Index i = 0; i < 4; ++i) patch.constraints.push_back({i, i + 1});
    const auto [mesh, report] = qmorph::convert(patch);
    CAPTURE(spokes);
    const auto broken = qmorph::test::broken_invariants(patch, mesh);
    CHECK_MESSAGE(broken.empty(), broken.front());
    CHECK(mesh.triangles.empty());
    const std::size_t cells = 8 * rows + 2 * spokes * (rows - 1), more = spokes % 2 == 1 ? 2 * (rows - 1) : 0;
    const std::size_t tips = spokes == 2 ? 0 : 2 * std::size_t((spokes + 1) / 2);  // in pairs, if not straight ones
    CHECK(report.layer_quads == cells + more + tips);
  }
}

TEST_CASE("layers: where each row would end in a triangle, rows are not cut in two for it") {
  constexpr Index kCells = 20, kRows = 16;
  Patch patch = grid(
      kCells, kRows, [](Index i, Index j) { return Vector3d(0.5 * i + j, j, 0); }, Diagonals::falling);
  for (Index j = 0; j < kRows; ++j) {  // beside the last column, four triangles around a node
    const Index a = j * (kCells + 1) + kCells, d = a + kCells + 1;
    const Vector3d p = patch.points[a], q = patch.points[d], right(1.5, 0, 0);
    if (j == 0) patch.points.push_back(p + right);
    const Index b = Index(patch.points.size() - 1);
    patch.points.insert(patch.points.end(), {(p + q + right) / 2, q + right});
    patch.triangles.insert(patch.triangles.end(), {{a, b, b + 1}, {b, b + 2, b + 1}, {b + 2, d, b + 1}, {d, a, b + 1}});
  }
  const auto [mesh, report] = qmorph::convert(patch);
  const auto broken = qmorph::test::broken_invariants(patch, mesh);
  CHECK_MESSAGE(broken.empty(), broken.front());
  CHECK(2 * mesh.quads.size() < patch.triangles.size() + patch.triangles.size() / 4);
}

TEST_CASE("layers: of one row with four nodes more on one side, two stretches between two of these are lost at most") {
  constexpr Index kCells = 60;
  const std::set<Index> more = {10, 20, 29, 39};
  Patch patch;
  Index below = 0, above = 1;
  patch.points = {{0, 0, 0}, {0, 1, 0}};
  const auto add = [&](const Vector3d& point) { return patch.points.push_back(point), Index(patch.points.size() - 1); };
  for (Index i = 0; i < kCells; ++i) {
    if (more.contains(i)) {
      const Index middle = add({3 * i + 1.5, 1, 0});
      patch.triangles.push_back({below, middle, above});
      above = middle;
    }
    const Index next_below = add({3.0 * i + 3, 0, 0}), next_above = add({3.0 * i + 3, 1, 0});
    patch.triangles.insert(patch.triangles.end(), {{below, next_below, above}, {next_below, next_above, above}});
    below = next_below, above = next_above;
  }
  const auto [mesh, report] = qmorph::convert(patch);
  const auto broken = qmorph::test::broken_invariants(patch, mesh);
  CHECK_MESSAGE(broken.empty(), broken.front());
  CHECK(report.layer_quads >= kCells - 2 * 12);
}

TEST_CASE("layers: where a row is no layer after all, the cell that it ends in is none either") {
  // Eight cells between two walls, and one more below a triangle, in a tip that is too large to be all cells.
  Patch patch = grid(9, 1, rectangles(4, 1));
  const Index a = 9, b = 18, c = 19;  // the lower right corner, and the upper side of the last cell
  const Index peak = Index(patch.points.size()), tip = peak + 1;
  patch.points.emplace_back(36, 1.6, 0);
  patch.points.emplace_back(40, 0.3, 0);
  patch.triangles.insert(patch.triangles.end(), {{b, c, peak}, {a, tip, c}, {c, tip, peak}});
  CHECK(layer_quads(patch) == 0);
}

TEST_CASE("layers: without the option none are found") {
  const Patch patch = grid(8, 6, rectangles(10, 1));
  qmorph::Options options;
  options.layers = false;
  CHECK(qmorph::convert(patch).report.layer_quads == 48);
  CHECK(qmorph::convert(patch, options).report.layer_quads == 0);
}

TEST_CASE("layers: an observer sees all stages, too, where nothing is left to the front") {
  struct Watcher : qmorph::Observer {
    bool wants_stages() const override { return true; }
    void stage_done(const qmorph::StageView& view) override {
      triangles.push_back(view.mesh.triangles.size());
      quads.push_back(view.mesh.quads.size());
      ratios = view.size_ratios.size();
    }
    std::vector<std::size_t> triangles, quads;
    std::size_t ratios = 0;
  } watcher;
  qmorph::Options options;
  options.observer = &watcher;
  const auto report = qmorph::convert(grid(8, 6, rectangles(10, 1)), options).report;
  REQUIRE(watcher.quads.size() == qmorph::kStages);
  CHECK(watcher.triangles.front() == 96);
  CHECK(watcher.quads.front() == 0);
  CHECK(watcher.quads.back() == 48);
  CHECK(watcher.ratios == 8 * 5 + 7 * 6);
  CHECK(report.regions == 1);
}

TEST_CASE("layers: around a node that no quads were found for, triangles are left to the front") {
  const Patch patch = grid(10, 10, rectangles(10, 1));
  std::vector<bool> without(patch.points.size(), false);
  without[5 * 11 + 5] = true;
  const auto layers = qmorph::layers::find_layers(patch, without, kCreaseAngle);
  REQUIRE(layers.has_value());
  CHECK(layers->quads == 96);
  CHECK(layers->patch.triangles.size() == 8);
}
