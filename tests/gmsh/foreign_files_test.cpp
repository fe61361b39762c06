// SPDX-License-Identifier: GPL-2.0-or-later
/// Files that no Gmsh wrote: without entities, tags, curves, order.

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "gmsh/model/patches.hpp"
#include "gmsh/support.hpp"

using namespace qmorph::test;

namespace {

/// A grid with the given tags on triangles and, if `line_tags` is not empty, on the lines of its outline.
std::string grid_file(const Grid& grid, const std::string& triangle_tags, const std::string& line_tags = {}) {
  std::vector<std::string> elements;
  if (!line_tags.empty())
    for (const auto& line : grid.outline()) elements.push_back(row("1 " + line_tags, line));
  for (const auto& triangle : grid.triangles()) elements.push_back(row("2 " + triangle_tags, triangle));
  return msh22(grid.nodes(), elements);
}

/// MSH 4.1 without $Entities, all nodes in one block of entity (dim, tag).
std::string msh41_one_block(const Grid& grid, int dim, int tag, bool lines) {
  const auto nodes = grid.nodes();
  const auto triangles = grid.triangles();
  const auto outline = grid.outline();
  const std::string count = std::to_string(nodes.size());
  std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 " + count + " 1 " + count + "\n" +
                     std::to_string(dim) + " " + std::to_string(tag) + " 0 " + count + "\n";
  for (std::size_t i = 1; i <= nodes.size(); ++i) text += std::to_string(i) + "\n";
  for (const auto& p : nodes)
    text += std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
  const std::size_t total = triangles.size() + (lines ? outline.size() : 0);
  text += "$EndNodes\n$Elements\n" + std::string(lines ? "2 " : "1 ") + std::to_string(total) + " 1 " +
          std::to_string(total) + "\n";
  int element = 0;
  if (lines) {
    text += "1 7 1 " + std::to_string(outline.size()) + "\n";
    for (const auto& line : outline) text += row(std::to_string(++element), line) + "\n";
  }
  text += "2 3 2 " + std::to_string(triangles.size()) + "\n";
  for (const auto& triangle : triangles) text += row(std::to_string(++element), triangle) + "\n";
  return text + "$EndElements\n";
}

bool has_edge(const Snapshot& snapshot, int surface, std::array<double, 3> a, std::array<double, 3> b) {
  const auto is = [&](std::size_t tag, const std::array<double, 3>& p) {
    const auto& q = snapshot.mesh.points[snapshot.mesh.rows.find(tag)];
    return std::abs(q.x() - p[0]) + std::abs(q.y() - p[1]) + std::abs(q.z() - p[2]) < 1e-9;
  };
  for (const auto& entity : snapshot.mesh.entities)
    if (entity.dim == 2 && entity.tag == surface)
      for (const auto& block : entity.blocks)
        for (std::size_t e = 0; e < block.tags.size(); ++e)
          for (std::size_t k = 0; k < block.nodes_per_element; ++k) {
            const std::size_t first = e * block.nodes_per_element;
            const std::size_t p = block.nodes[first + k];
            const std::size_t q = block.nodes[first + (k + 1) % block.nodes_per_element];
            if ((is(p, a) && is(q, b)) || (is(p, b) && is(q, a))) return true;
          }
  return false;
}

}  // namespace

TEST_CASE("foreign: MSH 2.2 with every kind of tag") {
  const struct {
    const char *triangles, *lines;
    int surface;
  } kCases[] = {
      {"2 0 1", "", 1},       // elementary tags only, no line
      {"2 0 3", "2 0 1", 3},  // with lines
      {"2 7 3", "2 9 1", 3},  // with physical tags
      {"2 0 0", "", 0},       // tag 0
      {"0", "", 0},           // no tags at all
  };
  for (const auto& the_case : kCases) {
    CAPTURE(the_case.triangles);
    const TemporaryDirectory directory;
    write_file(directory / "in.msh", grid_file(Grid{}, the_case.triangles, the_case.lines));
    const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
    CAPTURE(result.err);
    CHECK(result.status == 0);
    const Snapshot before = read_snapshot(directory / "in.msh"), after = read_snapshot(directory / "out.msh");
    CHECK(difference(before, after, {the_case.surface}) == "");
    CHECK(element_counts(after, the_case.surface).first == 0);
    CHECK(element_counts(after, the_case.surface).second > 0);
  }
}

TEST_CASE("foreign: MSH 4.1 without entities, all nodes in one block") {
  for (const auto& owner : {std::pair{2, 3}, std::pair{2, 99}, std::pair{3, 1}, std::pair{0, 1}, std::pair{1, 7}})
    for (const bool lines : {false, true}) {
      const int dim = owner.first, tag = owner.second;
      CAPTURE(dim);
      CAPTURE(tag);
      CAPTURE(lines);
      const TemporaryDirectory directory;
      write_file(directory / "in.msh", msh41_one_block(Grid{}, dim, tag, lines));
      const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
      CAPTURE(result.err);
      CHECK(result.status == 0);
      const Snapshot after = read_snapshot(directory / "out.msh");
      CHECK(element_counts(after, 3).first == 0);
      CHECK(element_counts(after, 3).second > 0);
      // Line elements are there, with their nodes; where nodes belong is what has been put right.
      for (const auto& entity : after.mesh.entities)
        if (entity.dim == 1 && lines) CHECK(entity.element_count() == 16);
    }
}

TEST_CASE("foreign: line elements inside a surface are kept as edges") {
  const TemporaryDirectory directory;
  const Grid grid;
  std::vector<std::string> elements;
  for (int i = 1; i < 3; ++i) elements.push_back(row<2>("1 2 0 5", {grid.node(i, i), grid.node(i + 1, i + 1)}));
  elements.push_back(row<1>("15 2 0 9", {grid.node(3, 1)}));
  for (const auto& triangle : grid.triangles()) elements.push_back(row("2 2 0 1", triangle));
  write_file(directory / "in.msh", msh22(grid.nodes(), elements));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  const Snapshot before = read_snapshot(directory / "in.msh"), after = read_snapshot(directory / "out.msh");
  CHECK(difference(before, after, {1}) == "");
  CHECK(has_edge(after, 1, {0.25, 0.25, 0}, {0.5, 0.5, 0}));
  CHECK(has_edge(after, 1, {0.5, 0.5, 0}, {0.75, 0.75, 0}));
}

TEST_CASE("foreign: surfaces that meet without a curve stay conforming") {
  // Left half, right half, and a wall that stands on their common edge: three surfaces, not one line.
  const TemporaryDirectory directory;
  const Grid grid;
  std::vector<std::array<double, 3>> nodes = grid.nodes();
  std::vector<std::string> elements;
  for (const auto& triangle : grid.triangles()) {
    const double x = (nodes[triangle[0] - 1][0] + nodes[triangle[1] - 1][0] + nodes[triangle[2] - 1][0]) / 3;
    elements.push_back(row(x < 0.5 ? "2 2 0 1" : "2 2 0 2", triangle));
  }
  const int top = static_cast<int>(nodes.size()) + 1;
  for (int j = 0; j <= 4; ++j) nodes.push_back({0.5, 0.25 * j, 0.25});
  for (int j = 0; j < 4; ++j) {
    elements.push_back(row<3>("2 2 0 3", {grid.node(2, j), grid.node(2, j + 1), top + j + 1}));
    elements.push_back(row<3>("2 2 0 3", {grid.node(2, j), top + j + 1, top + j}));
  }
  write_file(directory / "in.msh", msh22(nodes, elements));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  CHECK(difference(read_snapshot(directory / "in.msh"), read_snapshot(directory / "out.msh"), {1, 2, 3}) == "");
}

TEST_CASE("foreign: a wall that stands in the middle of one surface keeps its foot") {
  const TemporaryDirectory directory;
  const Grid grid;
  std::vector<std::array<double, 3>> nodes = grid.nodes();
  std::vector<std::string> elements;
  for (const auto& triangle : grid.triangles()) elements.push_back(row("2 2 0 1", triangle));
  const int top = static_cast<int>(nodes.size()) + 1;
  for (int j = 1; j <= 3; ++j) nodes.push_back({0.5, 0.25 * j, 0.25});
  for (int j = 1; j < 3; ++j) {
    elements.push_back(row<3>("2 2 0 3", {grid.node(2, j), grid.node(2, j + 1), top + j}));
    elements.push_back(row<3>("2 2 0 3", {grid.node(2, j), top + j, top + j - 1}));
  }
  write_file(directory / "in.msh", msh22(nodes, elements));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  const Snapshot after = read_snapshot(directory / "out.msh");
  CHECK(difference(read_snapshot(directory / "in.msh"), after, {1, 3}) == "");
  CHECK(has_edge(after, 1, {0.5, 0.25, 0}, {0.5, 0.5, 0}));
  CHECK(has_edge(after, 1, {0.5, 0.5, 0}, {0.5, 0.75, 0}));
}

TEST_CASE("foreign: one elementary tag for plates in different planes and orientations") {
  const TemporaryDirectory directory;
  Grid low, high;
  high.z = 1;
  high.first_node = static_cast<int>(low.nodes().size()) + 1;
  std::vector<std::array<double, 3>> nodes = low.nodes();
  for (auto p : high.nodes()) nodes.push_back({p[2] + 3, p[1], p[0]});  // upright
  std::vector<std::string> elements;
  for (const auto& triangle : low.triangles()) elements.push_back(row("2 2 0 1", triangle));
  for (const auto& triangle : high.triangles()) elements.push_back(row("2 2 0 1", triangle));
  write_file(directory / "in.msh", msh22(nodes, elements));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  CHECK(difference(read_snapshot(directory / "in.msh"), read_snapshot(directory / "out.msh"), {1}) == "");
}

TEST_CASE("foreign: triangles that are turned against their neighbours are turned back, with a warning") {
  const TemporaryDirectory directory;
  const Grid grid;
  std::vector<std::string> elements;
  for (auto triangle : grid.triangles()) {
    if (elements.size() % 5 == 2) std::swap(triangle[0], triangle[1]);
    elements.push_back(row("2 2 0 1", triangle));
  }
  write_file(directory / "in.msh", msh22(grid.nodes(), elements));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(result.status == 0);
  CHECK(result.err.find("6 elements were oriented against their neighbours") != std::string::npos);
  CHECK(result.err.find("warning: surface 1: ") != std::string::npos);
}

TEST_CASE("foreign: a surface that is clockwise stays clockwise") {
  const TemporaryDirectory directory;
  const Grid grid;
  std::vector<std::string> elements;
  for (auto triangle : grid.triangles()) {
    std::swap(triangle[0], triangle[1]);
    elements.push_back(row("2 2 0 1", triangle));
  }
  write_file(directory / "in.msh", msh22(grid.nodes(), elements));
  CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).status == 0);
  const Snapshot after = read_snapshot(directory / "out.msh");
  for (const auto& entity : after.mesh.entities)
    for (const auto& block : entity.blocks)
      for (std::size_t e = 0; e + 4 <= block.nodes.size(); e += 4) {
        const auto p = [&](std::size_t k) { return after.mesh.points[after.mesh.rows.find(block.nodes[e + k])]; };
        CHECK((p(1) - p(0)).cross(p(2) - p(1)).z() < 0);
      }
}

TEST_CASE("foreign: a mesh of another format keeps its curves as one of Gmsh's does, however odd they are") {
  const TemporaryDirectory directory;
  write_file(directory / "in.mesh",
             "MeshVersionFormatted 1\nDimension 3\nVertices\n6\n0 0 0 1\n2 0 0 1\n3 1 0 1\n1 3 0 1\n-1 1 0 1\n1 1 0 1\n"
             "Edges\n5\n1 2 1\n2 3 1\n3 4 1\n4 5 1\n5 1 1\n"
             "Triangles\n5\n1 2 6 1\n2 3 6 1\n3 4 6 1\n4 5 6 1\n5 1 6 1\nEnd\n");
  const Result result = run_qmorph({directory / "in.mesh", "-o", directory / "out.msh"});
  CHECK(result.status == 0);
  CHECK(result.err.find("1 triangle is left") != std::string::npos);
  const std::string after = difference(read_snapshot(directory / "in.mesh"), read_snapshot(directory / "out.msh"), {1});
  CHECK(after == "");
}

TEST_CASE("foreign: quads among the triangles of one surface are kept") {
  const TemporaryDirectory directory;
  const Grid grid;
  std::vector<std::string> elements;
  const auto triangles = grid.triangles();
  for (std::size_t cell = 0; 2 * cell < triangles.size(); ++cell) {
    const auto &a = triangles[2 * cell], &b = triangles[2 * cell + 1];
    if (cell % 4 == 0) {  // the first column
      elements.push_back(row<4>("3 2 0 1", {a[0], a[1], a[2], b[2]}));
    } else {
      elements.push_back(row("2 2 0 1", a));
      elements.push_back(row("2 2 0 1", b));
    }
  }
  write_file(directory / "in.msh", msh22(grid.nodes(), elements));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  const Snapshot before = read_snapshot(directory / "in.msh"), after = read_snapshot(directory / "out.msh");
  const auto* old_quads = before.mesh.entities[0].block(qmorph::adapter::kQuad4);
  const auto* new_quads = after.mesh.entities[0].block(qmorph::adapter::kQuad4);
  REQUIRE(old_quads->tags.size() == 4);
  for (std::size_t q = 0; q < 4; ++q) {
    const auto found = std::find(new_quads->tags.begin(), new_quads->tags.end(), old_quads->tags[q]);
    REQUIRE(found != new_quads->tags.end());
    const std::size_t at = 4 * static_cast<std::size_t>(found - new_quads->tags.begin());
    CHECK(std::equal(old_quads->nodes.begin() + 4 * q, old_quads->nodes.begin() + 4 * q + 4,
                     new_quads->nodes.begin() + at));
  }
}

TEST_CASE("foreign: coordinates with 17 digits come back bit for bit in MSH 2.2") {
  const TemporaryDirectory directory;
  Grid grid;
  grid.x = 0.1 + 0.2;  // 0.30000000000000004
  write_file(directory / "in.msh", grid_file(grid, "2 0 1", "2 0 1"));
  CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).status == 0);
  CHECK(read_file(directory / "out.msh").find("0.30000000000000004") != std::string::npos);
}

TEST_CASE("foreign: new nodes take free numbers below where there are none above") {
  const TemporaryDirectory directory;
  // A corner of 270 degrees, which no single quad can have.
  write_file(directory / "in.msh",
             "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n2147483644 0 0 0\n2147483645 2 -1 0\n"
             "2147483646 1 0 0\n2147483647 2 1 0\n$EndNodes\n$Elements\n2\n"
             "2147483646 2 2 1 1 2147483644 2147483645 2147483646\n"
             "2147483647 2 2 1 1 2147483644 2147483646 2147483647\n$EndElements\n");
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  REQUIRE(result.status == 0);
  const Snapshot after = read_snapshot(directory / "out.msh");
  CHECK(after.mesh.tags.size() > 4);
  CHECK(after.mesh.max_node_tag == 2147483647);
  CHECK(after.mesh.max_element_tag == 2147483647);
  CHECK(element_counts(after, 1).second > 2);
}

TEST_CASE("foreign: a name with a quote inside is not cut") {
  const TemporaryDirectory directory;
  const Grid grid;
  std::vector<std::string> elements;
  for (const auto& triangle : grid.triangles()) elements.push_back(row("2 2 3 1", triangle));
  const std::string names = "$PhysicalNames\n1\n2 3 \"2\" pipe\"\n$EndPhysicalNames\n";
  write_file(directory / "in.msh", msh22(grid.nodes(), elements, names));
  for (const char* format : {"msh22", "msh41"}) {
    CHECK(run_qmorph({directory / "in.msh", "-format", format, "-o", directory / "out.msh"}).status == 0);
    CHECK(read_file(directory / "out.msh").find(names) != std::string::npos);
  }
}
