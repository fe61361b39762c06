// SPDX-License-Identifier: GPL-2.0-or-later
// Curved surfaces and sheets in a model, from file to file.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <map>

#include "gmsh/session/compat.hpp"
#include "gmsh/support.hpp"

using namespace qmorph::test;

namespace {

/// Nodes and triangles of a file under way. Nodes at one place are one.
struct Draft {
  std::vector<std::array<double, 3>> nodes;
  std::vector<std::string> elements;
  std::map<std::array<long, 3>, int> node_at;

  int node(double x, double y, double z) {
    const std::array<long, 3> key{std::lround(x * 1e6), std::lround(y * 1e6), std::lround(z * 1e6)};
    const auto [at, is_new] = node_at.emplace(key, int(nodes.size()) + 1);
    if (is_new) nodes.push_back({x, y, z});
    return at->second;
  }

  /// A rectangle from p, n x n squares along u and v.
  void sheet(int surface, int n, const Eigen::Vector3d& p, const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
    const auto at = [&](int i, int j) {
      const Eigen::Vector3d q = p + u * i / n + v * j / n;
      return node(q.x(), q.y(), q.z());
    };
    const std::string tags = "2 2 0 " + std::to_string(surface);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        elements.push_back(row<3>(tags, {at(i, j), at(i + 1, j), at(i + 1, j + 1)}));
        elements.push_back(row<3>(tags, {at(i, j), at(i + 1, j + 1), at(i, j + 1)}));
      }
  }
};

}  // namespace

TEST_CASE("sheets: three that meet at a line become quads, and the line stays") {
  for (const bool one_surface : {true, false}) {
    CAPTURE(one_surface);
    Draft draft;
    const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), o(0, 0, 0);
    draft.sheet(1, 6, o, x, z);
    draft.sheet(one_surface ? 1 : 2, 6, o, -x, z);
    draft.sheet(one_surface ? 1 : 3, 6, o, y, z);
    const TemporaryDirectory directory;
    write_file(directory / "in.msh", msh22(draft.nodes, draft.elements));
    const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
    CAPTURE(result.err);
    CHECK(result.status == 0);
    const Snapshot after = read_snapshot(directory / "out.msh");
    std::size_t triangles = 0, quads = 0;
    for (int surface = 1; surface <= (one_surface ? 1 : 3); ++surface) {
      const auto [some_triangles, some_quads] = element_counts(after, surface);
      triangles += some_triangles, quads += some_quads;
    }
    CHECK(triangles == 0);
    CHECK(quads == 108);
  }
}

TEST_CASE("sheets: two between the same curves may have the same triangle at a corner") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [] {
    namespace occ = ::gmsh::model::occ;
    const int a = occ::addPoint(0, 0, 0), b = occ::addPoint(2, 0.4, 0), c = occ::addPoint(2, -0.4, 0);
    const int wire = occ::addWire({occ::addLine(a, b), occ::addLine(b, c), occ::addLine(c, a)}, -1, true);
    for (const double z : {-0.2, 0.2}) occ::addSurfaceFilling(wire, -1, {occ::addPoint(1.5, 0, z)});
    occ::synchronize();
    ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.25);
    ::gmsh::model::mesh::generate(2);
  });
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  const Snapshot after = read_snapshot(directory / "out.msh");
  for (const int surface : {1, 2}) {
    const auto [triangles, quads] = element_counts(after, surface);
    CHECK(triangles == 0);  // 52 triangles each: an even boundary
    CHECK(quads > 10);
  }
}

TEST_CASE("sheets: an edge that two happen to have inside does not part them, and nothing is odd") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [] {
    // Two surfaces with a curve of two segments between them; in each a triangle cuts it off.
    ::gmsh::model::addDiscreteEntity(0, 1);
    ::gmsh::model::addDiscreteEntity(0, 2);
    ::gmsh::model::addDiscreteEntity(1, 1, {1, 2});
    for (const int surface : {1, 2}) ::gmsh::model::addDiscreteEntity(2, surface, {1});
    ::gmsh::model::mesh::addNodes(0, 1, {1}, {0, 0, 0});
    ::gmsh::model::mesh::addNodes(0, 2, {2}, {1, 0, 0});
    ::gmsh::model::mesh::addNodes(1, 1, {3}, {0.5, 0.3, 0});
    ::gmsh::model::mesh::addNodes(2, 1, {4}, {0.5, -0.8, 0.3});
    ::gmsh::model::mesh::addNodes(2, 2, {5}, {0.5, -0.8, -0.3});
    ::gmsh::model::mesh::addElementsByType(1, 1, {1, 2}, {1, 3, 3, 2});
    ::gmsh::model::mesh::addElementsByType(1, 2, {3, 4}, {1, 2, 3, 1, 4, 2});
    ::gmsh::model::mesh::addElementsByType(2, 2, {5, 6}, {1, 2, 3, 1, 5, 2});
  });
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--all-quad"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  const Snapshot after = read_snapshot(directory / "out.msh");
  CHECK(after.mesh.tags.size() == 5);
  for (const int surface : {1, 2}) CHECK(element_counts(after, surface) == std::pair<std::size_t, std::size_t>(0, 1));
}
