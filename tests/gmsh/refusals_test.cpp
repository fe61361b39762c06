// SPDX-License-Identifier: GPL-2.0-or-later
/// What cannot be converted is left as it was, and reported: which surface, where, why. The rest is converted.

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A good plate as surface 1, and whatever is bad as surface 2 and at x = 10.
struct Mixed {
  Grid plate;
  std::vector<std::array<double, 3>> nodes = plate.nodes();
  std::vector<std::string> elements;
  Mixed() {
    for (const auto& triangle : plate.triangles()) elements.push_back(row("2 2 0 1", triangle));
  }
  int add(double x, double y, double z) {
    nodes.push_back({10 + x, y, z});
    return static_cast<int>(nodes.size());
  }
  void bad(int a, int b, int c) { elements.push_back(row<3>("2 2 0 2", {a, b, c})); }
};

void check_left(const Mixed& mixed, const std::string& message) {
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", msh22(mixed.nodes, mixed.elements));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 3);
  CHECK(mentions(result.err, message));
  CHECK(mentions(result.err, "qmorph: 1 of 2 surfaces left as they were: 2"));
  const Snapshot after = read_snapshot(directory / "out.msh");
  CHECK(element_counts(after, 1).first == 0);
  CHECK(difference(read_snapshot(directory / "in.msh"), after, {1}) == "");
}

}  // namespace

TEST_CASE("refused: the same triangle twice, with others around it") {
  Mixed mixed;
  const int a = mixed.add(0, 0, 0), b = mixed.add(1, 0, 0), c = mixed.add(0, 1, 0), d = mixed.add(1, 1, 0);
  mixed.bad(a, b, c);
  mixed.bad(a, b, c);
  mixed.bad(b, d, c);
  check_left(mixed, "it has an element twice");
}

TEST_CASE("refused: a Moebius strip") {
  Mixed mixed;
  constexpr int kCount = 9;
  std::vector<int> low, high;
  for (int i = 0; i < kCount; ++i) {
    low.push_back(mixed.add(i, 0, 0));
    high.push_back(mixed.add(i, 1, 0));
  }
  low.push_back(high[0]);  // the ends are glued with a half turn
  high.push_back(low[0]);
  for (int i = 0; i < kCount; ++i) {
    mixed.bad(low[i], low[i + 1], high[i]);
    mixed.bad(high[i], low[i + 1], high[i + 1]);
  }
  check_left(mixed, "it has no orientation, like a Moebius strip");
}

TEST_CASE("refused: a triangle with one node twice") {
  Mixed mixed;
  const int a = mixed.add(0, 0, 0), b = mixed.add(1, 0, 0), c = mixed.add(0, 1, 0);
  mixed.bad(a, b, c);
  mixed.bad(b, b, c);
  check_left(mixed, "uses node 27 at (11, 0, 0) twice");
}

TEST_CASE("refused: a quad of the input that is not convex") {
  Mixed mixed;
  const int a = mixed.add(0, 0, 0), b = mixed.add(2, 0, 0), c = mixed.add(0, 2, 0), d = mixed.add(0.2, 0.2, 0);
  mixed.elements.push_back(row<4>("3 2 0 2", {a, b, d, c}));
  SUBCASE("among triangles") { mixed.bad(b, c, d); }
  SUBCASE("among quads") {
    const int e = mixed.add(3, 3, 0);
    mixed.elements.push_back(row<4>("3 2 0 2", {b, e, c, d}));
  }
  check_left(mixed, "is inverted or not convex at (10.2, 0.2, 0)");
}

TEST_CASE("refused: a node whose coordinates are not numbers") {
  Mixed mixed;
  const int a = mixed.add(0, 0, 0), b = mixed.add(1, 0, 0);
  mixed.bad(a, b, mixed.add(0, std::nan(""), 0));
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", msh22(mixed.nodes, mixed.elements));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 3);
  CHECK(mentions(result.err, "surface 2: 1 triangle left as it was: node 28 at (10, nan, 0) is nowhere"));
}

TEST_CASE("refused: a mesh of quads only, with a node that has no place or an element with one node twice") {
  Mixed mixed;
  const int a = mixed.add(0, 0, 0), b = mixed.add(1, 0, 0), c = mixed.add(1, 1, 0);
  std::string message;
  SUBCASE("at no place") {
    mixed.elements.push_back(row<4>("3 2 0 2", {a, b, c, mixed.add(0, std::nan(""), 0)}));
    message = "node 29 at (10, nan, 0) is nowhere: its coordinates are not finite numbers";
  }
  SUBCASE("at no place that can be computed with") {
    mixed.elements.push_back(row<4>("3 2 0 2", {a, b, c, mixed.add(0, 1e160, 0)}));
    message = "node 29 at (10, 1e+160, 0) is too far away to compute with";
  }
  SUBCASE("twice") {
    mixed.elements.push_back(row<4>("3 2 0 2", {a, b, c, c}));
    message = "uses node 28 at (11, 1, 0) twice";
  }
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", msh22(mixed.nodes, mixed.elements));
  const std::vector<std::string> line{directory / "in.msh", "-o", directory / "out.msh"};
  for (const char* option : {"", "--cleanup-only"}) {
    CAPTURE(option);
    std::vector<std::string> words = line;
    if (*option) words.push_back(option);
    const Result result = run_qmorph(words);
    CAPTURE(result.err);
    CHECK(result.status == 3);
    CHECK(mentions(result.err, "surface 2: 1 quad left as it was: "));
    CHECK(mentions(result.err, message));
    CHECK(mentions(result.err, "qmorph: 1 of 2 surfaces left as they were: 2"));
  }
}

TEST_CASE("refused: a surface that bounds tetrahedra") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [] {
    ::gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
    ::gmsh::model::occ::synchronize();
    ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.4);
    ::gmsh::model::mesh::generate(3);
  });
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(result.status == 3);
  CHECK(mentions(result.err, "it bounds volume 1, meshed already"));
  CHECK(mentions(result.err, "--drop-volumes"));
  CHECK((read_file(directory / "in.msh") == read_file(directory / "out.msh")));
}

TEST_CASE("refused: two surfaces with the same elements") {
  const TemporaryDirectory directory;
  const Grid grid;
  std::vector<std::string> elements;
  for (const char* surface : {"2 2 0 1", "2 2 0 2"})
    for (const auto& triangle : grid.triangles()) elements.push_back(row(surface, triangle));
  write_file(directory / "in.msh", msh22(grid.nodes(), elements));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(result.status == 3);
  CHECK(mentions(result.err, "surface 2: 32 triangles left as they were: surface 1 has the same element at node"));
}

TEST_CASE("refused: not two surfaces that happen to have a triangle in common, between curves of both") {
  const TemporaryDirectory directory;
  // A hexagon in four triangles, and a bowl that hangs from its outline: the triangle in the middle is in both.
  std::vector<std::array<double, 3>> nodes;
  for (int k = 0; k < 6; ++k) nodes.push_back({std::cos(k * M_PI / 3), std::sin(k * M_PI / 3), 0});
  std::vector<std::string> elements;
  for (int k = 0; k < 6; ++k) elements.push_back(row("1 2 0 1", std::array<int, 2>{k + 1, (k + 1) % 6 + 1}));
  for (const char* surface : {"2 2 0 1", "2 2 0 2"}) elements.push_back(row(surface, std::array<int, 3>{1, 3, 5}));
  for (int k = 0; k < 6; k += 2) {
    const std::array<int, 3> ear{k + 1, k + 2, (k + 2) % 6 + 1};
    elements.push_back(row("2 2 0 1", ear));
    nodes.push_back({0.85 * std::cos((k + 1) * M_PI / 3), 0.85 * std::sin((k + 1) * M_PI / 3), -0.1});
    const int inside = int(nodes.size());
    for (int side = 0; side < 3; ++side)
      elements.push_back(
          row("2 2 0 2", std::array<int, 3>{ear[std::size_t(side)], ear[std::size_t(side + 1) % 3], inside}));
  }
  write_file(directory / "in.msh", msh22(nodes, elements));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
}

TEST_CASE("refused: coordinates whose squares are no numbers") {
  Mixed mixed;
  const int a = mixed.add(0, 0, 0), b = mixed.add(1e160, 0, 0);
  mixed.bad(a, b, mixed.add(0, 1e160, 0));
  check_left(mixed, "node 27 at (1e+160, 0, 0) is too far away to compute with");
}

TEST_CASE("refused: two nodes with the same tag, an element whose node is missing") {
  const TemporaryDirectory directory;
  const Grid grid;
  std::vector<std::string> elements;
  for (const auto& triangle : grid.triangles()) elements.push_back(row("2 2 0 1", triangle));
  std::string text = msh22(grid.nodes(), elements);
  elements.push_back("2 2 0 1 1 2 4711");
  write_file(directory / "unknown.msh", msh22(grid.nodes(), elements));
  text.replace(text.find("\n7 "), 3, "\n6 ");
  write_file(directory / "twice.msh", text);
  for (const char* name : {"unknown.msh", "twice.msh"}) {
    CAPTURE(name);
    const Result result = run_qmorph({directory / name, "-o", directory / "out.msh"});
    CAPTURE(result.err);
    CHECK(result.status == 2);
  }
  CHECK(directory.files() == std::vector<std::string>{"twice.msh", "unknown.msh"});
}
