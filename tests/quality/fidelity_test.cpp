// SPDX-License-Identifier: GPL-2.0-or-later
#include "qmorph/fidelity.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "qmorph/convert.hpp"
#include "space/grids.hpp"
#include "space/triangle_tree.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using Eigen::Vector3d;

Fidelity fidelity(const Patch& before, const QuadMesh& after) {
  FidelityAccumulator accumulator;
  accumulator.add(before, after);
  return accumulator.result();
}

Vector3d centre_of(const QuadMesh& mesh, Index q) {
  Vector3d centre = Vector3d::Zero();
  for (Index v : mesh.quads[q]) centre += 0.25 * mesh.points[v];
  return centre;
}

TEST_CASE("fidelity: of quads on the input's nodes, only sides and centres are off the surface") {
  // Cells of 1 by 1 around a cylinder of eight sides: every cell is flat.
  const GridSurface grid{.across = 8, .along = 4};
  const Patch patch = cylinder(grid);
  GridSurface closed = grid;
  closed.closed_across = true;
  const QuadMesh mesh = quads_of(closed, patch);
  const Fidelity flat_cells = fidelity(patch, mesh);
  CHECK(flat_cells.quads == 32);
  for (const Spread& s : {flat_cells.node, flat_cells.side, flat_cells.centre, flat_cells.back}) CHECK(s.max < 1e-7);
  CHECK(flat_cells.warpage_deg.max < 1e-5);
  CHECK(flat_cells.normal_deg.max < 1e-5);
}

TEST_CASE("fidelity: distances are those to the closest triangle of all, over the edges there") {
  const GridSurface grid{.across = 18, .along = 9, .jitter = 0.2, .closed_across = true, .closed_along = true};
  const Patch patch = torus(grid);
  QuadMesh mesh = quads_of(grid, patch);
  const Index moved = 5 * 18 + 6;
  mesh.points[moved] *= 1.01;  // off the surface
  const space::TriangleTree tree(patch.points, patch.triangles);
  std::vector<double> length(mesh.points.size(), 0);  // every node has four edges, each of them in two quads
  for (const auto& quad : mesh.quads)
    for (int i = 0; i < 4; ++i) {
      const Index a = quad[i], b = quad[(i + 1) % 4];
      for (Index v : {a, b}) length[v] += (mesh.points[a] - mesh.points[b]).norm() / 8;
    }
  double sum = 0, most = 0;
  for (Index q = 0; q < mesh.quads.size(); ++q) {
    double edges = 0;
    for (Index v : mesh.quads[q]) edges += 0.25 * length[v];
    const double off = std::sqrt(tree.closest(centre_of(mesh, q)).distance2) / edges;
    sum += off;
    most = std::max(most, off);
  }
  const Fidelity f = fidelity(patch, mesh);
  CHECK(f.centre.mean == doctest::Approx(sum / double(mesh.quads.size())).epsilon(1e-6));
  CHECK(f.centre.max == doctest::Approx(most).epsilon(1e-6));
  CHECK(f.node.where == mesh.points[moved]);
  CHECK(f.node.max == doctest::Approx(std::sqrt(tree.closest(mesh.points[moved]).distance2) / length[moved]));
  CHECK(f.node.mean == doctest::Approx(f.node.max / double(mesh.points.size())));
  CHECK(f.back.max > 0.5 * f.node.max);
}

TEST_CASE("fidelity: a converted surface has its nodes on the input, and planar surfaces have no figures") {
  const Patch patch = cylinder({.across = 24, .along = 9, .jitter = 0.2}, 0.5);
  const QuadMesh mesh = convert(patch).mesh;
  const Fidelity f = fidelity(patch, mesh);
  CHECK(f.quads == mesh.quads.size());
  CHECK(f.node.max < 1e-10);
  CHECK(f.centre.mean > 0);
  CHECK(f.centre.max < 0.1);
  CHECK(f.back.max < 0.2);
  Patch flat = triangulated({.across = 5, .along = 5}, [](double u, double v) { return Vector3d(u, v, 1); });
  CHECK(fidelity(flat, convert(flat).mesh).quads == 0);
}

TEST_CASE("fidelity: figures of two surfaces add up") {
  const Patch one = cylinder({.across = 12, .along = 5}, 0.5), other = torus({.across = 12, .along = 8});
  const QuadMesh first = convert(one).mesh, second = convert(other).mesh;
  FidelityAccumulator both, sum, last;
  both.add(one, first);
  both.add(other, second);
  sum.add(one, first);
  last.add(other, second);
  sum.add(last);
  CHECK(both.result().centre.mean == doctest::Approx(sum.result().centre.mean));
  CHECK(both.result().warpage_deg.max == sum.result().warpage_deg.max);
  CHECK(both.result().back.where == sum.result().back.where);
  CHECK(both.result().quads == first.quads.size() + second.quads.size());
}

}  // namespace
