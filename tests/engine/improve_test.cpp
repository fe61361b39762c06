// SPDX-License-Identifier: GPL-2.0-or-later
// Quads and triangles in, better quads out.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "qmorph/check.hpp"
#include "qmorph/convert.hpp"
#include "qmorph/quality.hpp"
#include "support/domains.hpp"
#include "support/invariants.hpp"
#include "support/rng.hpp"
#include "support/seeds.hpp"
#include "support/watcher.hpp"

namespace {

using qmorph::improve;
using qmorph::Index;
using qmorph::Patch;
using qmorph::QuadMesh;
using qmorph::test::allows_laws;
using qmorph::test::broken_invariants;
using qmorph::test::seeds;

/// A grid of unit squares, n by m; node (x, y) is row x + y * (n + 1).
Patch grid(Index n, Index m) {
  Patch patch;
  for (Index y = 0; y <= m; ++y)
    for (Index x = 0; x <= n; ++x) patch.points.emplace_back(x, y, 0);
  for (Index y = 0; y < m; ++y)
    for (Index x = 0; x < n; ++x) {
      const Index a = x + y * (n + 1), d = a + n + 1;
      patch.quads.push_back({a, a + 1, d + 1, d});
    }
  return patch;
}

/// The invariants speak of triangles to convert: the quads of the patch, cut.
std::vector<std::string> broken(Patch patch, const QuadMesh& mesh) {
  for (const auto& q : patch.quads) {
    patch.triangles.push_back({q[0], q[1], q[2]});
    patch.triangles.push_back({q[0], q[2], q[3]});
  }
  patch.quads.clear();
  return broken_invariants(patch, mesh);
}

/// Joins triangles at random, whatever shape the quads have: what a careless program makes.
Patch join_at_random(const Patch& in, std::uint64_t seed) {
  std::map<std::pair<Index, Index>, Index> triangle_at;
  for (Index t = 0; t < in.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) triangle_at[{in.triangles[t][i], in.triangles[t][(i + 1) % 3]}] = t;
  std::set<std::pair<Index, Index>> closed;
  for (const auto& [a, b] : in.constraints) closed.insert({a, b}), closed.insert({b, a});
  qmorph::test::Rng rng(seed);
  std::vector<bool> used(in.triangles.size(), false);
  Patch out = in;
  out.triangles.clear();
  for (Index t = 0; t < in.triangles.size(); ++t) {
    if (used[t]) continue;
    used[t] = true;
    const auto& n = in.triangles[t];
    bool joined = false;
    for (int i = 0; i < 3 && !joined; ++i) {
      const auto beyond = triangle_at.find({n[(i + 1) % 3], n[i]});
      if (beyond == triangle_at.end() || used[beyond->second] || closed.count({n[i], n[(i + 1) % 3]}) ||
          rng.chance(0.2))
        continue;
      const auto& m = in.triangles[beyond->second];
      for (int k = 0; k < 3; ++k)
        if (m[k] != n[i] && m[k] != n[(i + 1) % 3]) out.quads.push_back({n[i], m[k], n[(i + 1) % 3], n[(i + 2) % 3]});
      used[beyond->second] = joined = true;
    }
    if (!joined) out.triangles.push_back(n);
  }
  return out;
}

/// Throws one free node in fifty or so over its neighbours.
Patch throw_nodes(Patch patch, const Patch& triangles, std::uint64_t seed) {
  std::map<std::pair<Index, Index>, int> uses;
  for (const auto& t : triangles.triangles)
    for (int i = 0; i < 3; ++i) ++uses[std::minmax(t[i], t[(i + 1) % 3])];
  std::set<Index> held(patch.fixed.begin(), patch.fixed.end());
  for (const auto& [edge, count] : uses)
    if (count == 1) held.insert({edge.first, edge.second});
  for (const auto& [a, b] : patch.constraints) held.insert({a, b});
  qmorph::test::Rng rng(seed);
  for (const auto& t : triangles.triangles)
    if (!held.count(t[0]) && rng.chance(0.01))
      patch.points[t[0]] += rng.between(-1.5, 1.5) * (triangles.points[t[1]] - triangles.points[t[0]]) +
                            rng.between(-1.5, 1.5) * (triangles.points[t[2]] - triangles.points[t[0]]);
  return patch;
}

}  // namespace

TEST_CASE("improve: a grid stays a grid") {
  const Patch patch = grid(6, 4);
  const QuadMesh mesh = improve(patch).mesh;
  CHECK(broken(patch, mesh).empty());
  CHECK(mesh.quads.size() == 24);
  CHECK(mesh.points == patch.points);
}

TEST_CASE("improve: triangles that were joined at random become quads within the invariants") {
  for (std::uint64_t seed = 0; seed < seeds(150, 15); ++seed) {
    CAPTURE(seed);
    const Patch triangles = qmorph::test::random_domain(seed).patch;
    if (!triangles.quads.empty()) continue;
    const Patch patch = join_at_random(triangles, seed);
    const QuadMesh mesh = improve(patch).mesh;
    const auto complaints = broken_invariants(triangles, mesh);
    if (!complaints.empty()) FAIL_CHECK(complaints.front());
  }
}

TEST_CASE(
    "improve: elements that were turned over at random are mended but for a few, which are refused with their place") {
  int domains = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    const Patch triangles = qmorph::test::random_domain(seed).patch;
    if (!triangles.quads.empty()) continue;
    ++domains;
    try {
      const QuadMesh mesh = improve(throw_nodes(join_at_random(triangles, seed), triangles, seed)).mesh;
      const auto complaints = broken_invariants(triangles, mesh);
      if (!complaints.empty()) FAIL_CHECK(complaints.front());
    } catch (const qmorph::SurfaceError& error) {
      ++refused;
      const std::string what = error.what();
      CAPTURE(what);
      CHECK(what.find("is turned over, and no place was found") != std::string::npos);
    }
  }
  CHECK(20 * refused < domains);
}

TEST_CASE("improve: a pair of triangles far apart meets") {
  Patch patch = grid(9, 5);
  const auto cut = [&](std::size_t q) {
    const auto n = patch.quads[q];
    patch.quads.erase(patch.quads.begin() + std::ptrdiff_t(q));
    patch.triangles.push_back({n[0], n[1], n[2]});
    patch.triangles.push_back({n[0], n[2], n[3]});
  };
  cut(40);
  cut(3);
  const QuadMesh mesh = improve(patch).mesh;
  CHECK(broken(patch, mesh).empty());
  CHECK(mesh.quads.size() == 45);
  CHECK(qmorph::measure(mesh).irregular_nodes == 0);
}

TEST_CASE("improve: a node that was pulled over its neighbours goes back") {
  Patch patch = grid(6, 6);
  SUBCASE("one") { patch.points[3 + 3 * 7] = {5.2, 4.4, 0}; }
  SUBCASE("two next to each other") {
    patch.points[3 + 3 * 7] = {5.2, 4.4, 0};
    patch.points[3 + 4 * 7] = {4.3, 1.5, 0};
  }
  SUBCASE("a chevron") { patch.points[3 + 3 * 7] = {3.8, 3.8, 0}; }
  const QuadMesh mesh = improve(patch).mesh;
  CHECK(broken(grid(6, 6), mesh).empty());
  CHECK(mesh.quads.size() == 36);
  CHECK(qmorph::measure(mesh).scaled_jacobian_min > 0.99);
}

TEST_CASE("improve: on a curved surface nodes that have changed places go back, or it is said where they cannot") {
  const auto bent = [](Index moved) {  // node (3, 3) and another one have changed places
    Patch patch = grid(8, 6);
    for (auto& p : patch.points) p = {5 * std::sin(p.x() / 5), p.y(), 5 * std::cos(p.x() / 5)};
    std::swap(patch.points[3 + 3 * 9], patch.points[moved]);
    return patch;
  };
  const QuadMesh mesh = improve(bent(4 + 3 * 9)).mesh;
  CHECK(mesh.quads.size() == 48);
  CHECK(mesh.triangles.empty());
  CHECK(qmorph::measure(mesh).scaled_jacobian_min > 0.5);
  try {
    const QuadMesh other = improve(bent(5 + 4 * 9)).mesh;
    CHECK(qmorph::measure(other).scaled_jacobian_min > 0);
  } catch (const qmorph::SurfaceError& error) {
    CHECK(error.details().place.has_value());
  }
}

namespace {

/// A dome over the grid, open below.
Eigen::Vector3d on_dome(double x, double y) { return {x, y, 3 - 0.1 * (x * x + y * y)}; }

Patch dome(Index n) {
  Patch patch = grid(n, n);
  for (auto& p : patch.points) p = on_dome(p.x() - 0.5 * double(n), p.y() - 0.5 * double(n));
  return patch;
}

/// Some corner turns against the dome itself, whatever the elements of the input say.
bool has_turned_over(const QuadMesh& mesh) {
  const auto turns = [&](const auto& element) {
    for (std::size_t i = 0; i < element.size(); ++i) {
      const auto at = [&](std::size_t k) { return mesh.points[element[(i + k) % element.size()]]; };
      const Eigen::Vector3d normal(0.2 * at(0).x(), 0.2 * at(0).y(), 1);
      if (!((at(1) - at(0)).cross(at(element.size() - 1) - at(0)).dot(normal) > 0)) return true;
    }
    return false;
  };
  return std::any_of(mesh.quads.begin(), mesh.quads.end(), turns) ||
         std::any_of(mesh.triangles.begin(), mesh.triangles.end(), turns);
}

/// What says the patch itself for a result.
QuadMesh unchanged(const Patch& patch) {
  QuadMesh mesh{patch.points, {}, patch.triangles, patch.quads};
  for (Index i = 0; i < patch.points.size(); ++i) mesh.source.push_back(i);
  return mesh;
}

/// Refused with a place.
bool is_refused(const Patch& patch) {
  try {
    improve(patch);
  } catch (const qmorph::SurfaceError& error) {
    return error.details().place.has_value();
  }
  return false;
}

}  // namespace

TEST_CASE("improve: a quad that crosses itself and has nothing around it is refused, and no good result") {
  Patch patch;
  patch.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  patch.quads = {{0, 1, 2, 3}};
  SUBCASE("in a plane, with as much on one side as on the other") {}
  SUBCASE("more on one side") { patch.points[1] = {2, 0, 0}; }
  SUBCASE("in space") { patch.points[2].z() = 0.2; }
  CHECK(is_refused(patch));
  CHECK(qmorph::find_defect(patch, unchanged(patch), qmorph::InputQuads::free).has_value());
}

TEST_CASE("improve: on a dome nothing stays turned over where the input's own elements are, or it is refused") {
  struct Swap {
    Index a, b;
  };
  // Node (x, y) of a grid of 5 by 5 is x + 6 y: inside beside each other, across, farther; at the rim.
  for (const Swap swap : {Swap{14, 15}, {14, 21}, {13, 22}, {7, 14}, {14, 28}, {1, 2}, {2, 9}, {0, 7}}) {
    CAPTURE(swap.a);
    CAPTURE(swap.b);
    Patch patch = dome(5);
    std::swap(patch.points[swap.a], patch.points[swap.b]);
    CHECK(qmorph::find_defect(patch, unchanged(patch), qmorph::InputQuads::free).has_value());
    try {
      const QuadMesh mesh = improve(patch).mesh;
      CHECK_FALSE(has_turned_over(mesh));
      CHECK_FALSE(qmorph::find_defect(patch, mesh, qmorph::InputQuads::free).has_value());
      qmorph::QualityAccumulator quality;
      quality.add(patch, mesh);
      CHECK(quality.result().scaled_jacobian_min > 0);
    } catch (const qmorph::SurfaceError& error) {
      CHECK(error.details().place.has_value());
    }
  }
}

TEST_CASE("improve: a quad that is turned over among others on a dome turns back, or it is refused") {
  for (const Index q : {12, 2, 0}) {
    Patch patch = dome(5);
    std::reverse(patch.quads[q].begin(), patch.quads[q].end());
    CAPTURE(q);
    try {
      const QuadMesh mesh = improve(patch).mesh;
      CHECK_FALSE(has_turned_over(mesh));
    } catch (const qmorph::SurfaceError& error) {
      CHECK(error.details().place.has_value());
    }
  }
}

TEST_CASE("improve: no node has left a surface whose quads are bent alike along both diagonals") {
  Patch patch = grid(4, 3);
  for (auto& p : patch.points) p.z() = 0.1 * ((p.x() - 2) * (p.x() - 2) - (p.y() - 1.5) * (p.y() - 1.5));
  std::swap(patch.points[6], patch.points[7]);
  const QuadMesh mesh = improve(patch).mesh;
  const auto defect = qmorph::find_defect(patch, mesh, qmorph::InputQuads::free);
  CHECK_MESSAGE(!defect, (defect ? defect->what : ""));
}

TEST_CASE("improve: a sharp edge between good quads is no fault") {
  Patch patch = grid(8, 4);  // the upper side comes back over the lower one, 20 degrees above it
  for (auto& p : patch.points)
    if (p.x() > 4) p = {4 - 0.94 * (p.x() - 4), p.y(), 0.34 * (p.x() - 4)};
  const QuadMesh mesh = improve(patch).mesh;
  CHECK(mesh.quads.size() == 32);
  CHECK_FALSE(qmorph::find_defect(patch, mesh, qmorph::InputQuads::free).has_value());
}

TEST_CASE("improve: a quad whose corners cannot move is cut and built anew") {
  // A bar with a notch from below to node 5. All nodes are on the boundary.
  //   4---3---2
  //   |  5    |
  //   0 /   \ 1
  Patch patch;
  patch.points = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {2, 3, 0}, {0, 3, 0}, {2, 1, 0}};
  patch.quads = {{0, 5, 3, 4}, {5, 1, 2, 3}};
  SUBCASE("beside each other") {}
  SUBCASE("the tip belongs to one quad and two triangles") {
    patch.quads = {{0, 5, 1, 3}};
    patch.triangles = {{0, 3, 4}, {1, 2, 3}};
  }
  const QuadMesh mesh = improve(patch).mesh;
  CHECK(broken(patch, mesh).empty());
  CHECK(mesh.triangles.empty());
}

TEST_CASE("improve: nodes with two neighbours are removed") {
  Patch patch = grid(4, 4);
  // The square at the centre left becomes two quads around a node inside.
  const auto n = patch.quads[5];
  const auto inner = Index(patch.points.size());
  patch.points.emplace_back(1.6, 1.4, 0);
  patch.quads[5] = {n[0], n[1], n[2], inner};
  patch.quads.push_back({n[0], inner, n[2], n[3]});
  const QuadMesh mesh = improve(patch).mesh;
  CHECK(mesh.quads.size() == 16);
  CHECK(qmorph::measure(mesh).irregular_nodes == 0);
}

TEST_CASE("improve: constraints, fixed nodes and odd boundaries are respected") {
  Patch patch = grid(6, 5);
  patch.constraints = {{1 + 7, 2 + 7}, {2 + 7, 3 + 7}};
  patch.fixed = {4 + 3 * 7};
  patch.points[4 + 3 * 7] += Eigen::Vector3d(0.3, 0.2, 0);
  patch.quads.pop_back();  // the corner square becomes a triangle
  patch.triangles.push_back({5 + 4 * 7, 6 + 4 * 7, 5 + 5 * 7});
  const QuadMesh mesh = improve(patch).mesh;
  CHECK(broken(patch, mesh).empty());
  CHECK(mesh.triangles.size() == 1);
}

TEST_CASE("improve: a constraint along the diagonal of a quad cuts it") {
  Patch patch = grid(3, 3);
  patch.points[1 + 4] += Eigen::Vector3d(0.2, 0.1, 0);  // one diagonal leaves better halves than the other
  for (const auto& diagonal : {std::array<qmorph::Index, 2>{1 + 4, 2 + 2 * 4}, {2 + 4, 1 + 2 * 4}}) {
    patch.constraints = {diagonal};
    const QuadMesh mesh = improve(patch).mesh;
    CHECK(broken(patch, mesh).empty());
  }
}

TEST_CASE("improve: a fold in the boundary is refused, with its place") {
  Patch patch = grid(3, 2);
  patch.points[1] = {1, 2.5, 0};
  try {
    improve(patch);
    FAIL("nothing was said");
  } catch (const qmorph::SurfaceError& error) {
    const std::string what = error.what();
    CAPTURE(what);
    CHECK(what.find("(1, 2.5, 0)") != std::string::npos);
  }
}

TEST_CASE("improve: an empty mesh stays empty, and stages are timed as in a conversion") {
  CHECK(improve(Patch{}).mesh.quads.empty());
  qmorph::Options options;
  qmorph::test::Watcher watcher;
  options.observer = &watcher;
  improve(grid(3, 2), options);
  REQUIRE(watcher.stages.size() == qmorph::kStages);
  CHECK(watcher.stages.front().mesh.quads.size() == 6);
  CHECK(watcher.stages.front().mesh.triangles.empty());
  CHECK(watcher.stages.back().mesh.quads.size() == 6);
}

namespace {

/// What a region may not get worse in, of a whole mesh.
struct Figures {
  double least = 1, mean = 1;
  std::size_t poor = 0;
};

Figures figures_of(const std::vector<Eigen::Vector3d>& points, const std::vector<std::array<Index, 4>>& quads) {
  Figures figures;
  double sum = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const auto& q : quads) normal += (points[q[2]] - points[q[0]]).cross(points[q[3]] - points[q[1]]);
  for (const auto& q : quads) {
    const double value = qmorph::scaled_jacobian(
        qmorph::QuadCorners{points[q[0]], points[q[1]], points[q[2]], points[q[3]]}, normal.normalized());
    figures.least = std::min(figures.least, value);
    figures.poor += value < 0.2;
    sum += value;
  }
  if (!quads.empty()) figures.mean = sum / double(quads.size());
  return figures;
}

/// A patch of one region of all the elements of another mesh.
Patch as_patch(const QuadMesh& mesh, const Patch& of) {
  Patch patch;
  patch.points = mesh.points;
  patch.quads = mesh.quads;
  patch.triangles = mesh.triangles;
  std::map<Index, Index> row;
  for (Index i = 0; i < mesh.source.size(); ++i)
    if (mesh.source[i] != qmorph::kNone) row[mesh.source[i]] = i;
  for (const auto& [a, b] : of.constraints) patch.constraints.push_back({row.at(a), row.at(b)});
  for (const Index v : of.fixed) patch.fixed.push_back(row.at(v));
  return patch;
}

void check_no_worse(const Patch& patch, const qmorph::Conversion& done) {
  const QuadMesh& mesh = done.mesh;
  const Figures before = figures_of(patch.points, patch.quads), after = figures_of(mesh.points, mesh.quads);
  CHECK(after.least > before.least - 1e-9);
  CHECK(after.poor <= before.poor);
  // Regions with different numbers of quads weigh differently before and after.
  if (done.report.regions == 1) CHECK(after.mean > before.mean - 1e-9);
}

}  // namespace

TEST_CASE("improve: what is good stays as good") {
  for (std::uint64_t seed = 0; seed < seeds(100, 10); ++seed) {
    CAPTURE(seed);
    const Patch triangles = qmorph::test::random_domain(seed).patch;
    if (!triangles.quads.empty()) continue;
    const Patch patch = as_patch(qmorph::convert(triangles).mesh, triangles);
    const qmorph::Conversion done = improve(patch);
    CHECK(done.report.worse_regions == 0);
    check_no_worse(patch, done);
  }
}

TEST_CASE("improve: no region gets worse, except where triangles have to go") {
  int worse = 0, regions = 0;
  for (std::uint64_t seed = 0; seed < seeds(100, 10); ++seed) {
    CAPTURE(seed);
    const Patch triangles = qmorph::test::random_domain(seed).patch;
    if (!triangles.quads.empty()) continue;
    const Patch patch = join_at_random(triangles, seed);
    const qmorph::Conversion done = improve(patch);
    regions += int(done.report.regions), worse += int(done.report.worse_regions);
    if (done.report.worse_regions == 0)
      check_no_worse(patch, done);
    else
      CHECK(patch.triangles.size() > done.report.odd_regions);
  }
  if (allows_laws(seeds(100, 10))) CHECK(10 * worse < regions);
}

TEST_CASE("improve: rows of stretched quads with a few triangles among them stay rows") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    qmorph::test::Rng rng(seed);
    Patch patch = grid(30, 10);
    double y = 0;
    for (Index row = 0; row <= 10; ++row, y += 0.02 * std::pow(1.3, double(row)))
      for (Index x = 0; x <= 30; ++x) patch.points[x + row * 31].y() = y;
    for (int cut = 0; cut < 4; ++cut) {  // eight triangles
      const std::size_t at = rng.below(patch.quads.size());
      const auto q = patch.quads[at];
      patch.quads.erase(patch.quads.begin() + std::ptrdiff_t(at));
      patch.triangles.push_back({q[0], q[1], q[2]});
      patch.triangles.push_back({q[0], q[2], q[3]});
    }
    const qmorph::Conversion done = improve(patch);
    CHECK(done.mesh.triangles.empty());
    CHECK(done.mesh.quads.size() == 300);
    check_no_worse(patch, done);
  }
}
