// SPDX-License-Identifier: GPL-2.0-or-later
/// --check judges a mesh and writes nothing.

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "gmsh/support.hpp"

using namespace qmorph::test;

namespace {

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("check: a mesh that is good enough has status 0 and one line") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo",
             "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\nMesh.MeshSizeMax = 0.3;\n");
  REQUIRE(run_qmorph({directory / "in.geo"}).status == 0);
  const Result result =
      run_qmorph({"--check", directory / "in.msh", "--min-sj", "0.2", "--max-irregular=0.5", "--no-triangles"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  CHECK(mentions(result.out, " quads on 1 surface; scaled Jacobian min "));
  CHECK(std::count(result.out.begin(), result.out.end(), '\n') == 1);
  CHECK(result.err.empty());
  CHECK(run_qmorph({"--check", directory / "in.msh", "-v", "0"}).out.empty());
  CHECK(directory.files() == std::vector<std::string>{"in.geo", "in.msh"});
}

TEST_CASE("check: a line for each reason, and status 6") {
  const TemporaryDirectory directory;
  const std::vector<std::array<double, 3>> nodes = {{0, 0, 0}, {2, 0, 0}, {2, 0.2, 0},   {1, 1, 0}, {0, 1, 0},
                                                    {5, 0, 0}, {6, 0, 0}, {5.1, 0.1, 0}, {5, 1, 0}};
  write_file(directory / "in.msh", msh22(nodes, {"3 2 0 1 1 2 3 4", "2 2 0 1 1 4 5", "3 2 0 2 6 7 8 9"}));
  const Result lenient = run_qmorph({"--check", directory / "in.msh"});
  CHECK(lenient.status == 6);
  CHECK(lenient.err == "qmorph: surface 2: 1 inverted or not convex\n");
  const Result strict = run_qmorph({"--check", directory / "in.msh", "--min-sj", "0.9", "--no-triangles"});
  CAPTURE(strict.err);
  CHECK(strict.status == 6);
  CHECK(mentions(strict.err, "qmorph: surface 1: scaled Jacobian 0."));
  CHECK(mentions(strict.err, "and more than 0.9 is asked for\n"));
  CHECK(mentions(strict.err, "qmorph: surface 1: 1 triangle, and none is allowed\n"));
}

TEST_CASE("check: a surface where three elements share an edge is not a good mesh") {
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", msh22({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                                         {"2 2 0 1 1 2 3", "2 2 0 1 1 2 4", "2 2 0 1 1 2 5"}));
  const Result result = run_qmorph({"--check", directory / "in.msh"});
  CHECK(result.status == 6);
  CHECK(mentions(result.err, "surface 1: it is not a manifold"));
}

TEST_CASE("check: files that are not meshes") {
  const TemporaryDirectory directory;
  CHECK(run_qmorph({"--check", directory / "none.msh"}).status == 2);
  write_file(directory / "in.geo", "Point(1) = {0, 0, 0, 1};\n");
  CHECK(run_qmorph({"--check", directory / "in.geo"}).status == 2);
  CHECK(run_qmorph({directory / "in.geo", "--min-sj", "0.2"}).status == 1);
}

TEST_CASE("check: options that ask for a file are refused, since it writes none") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  for (const char* option : {"-o", "--stats", "--svg"}) {
    CAPTURE(option);
    const Result result = run_qmorph({"--check", directory / "in.msh", option, directory / "foo.msh"});
    CHECK(result.status == 1);
    CHECK(mentions(result.err, std::string("--check writes nothing; leave out ") + option));
    CHECK(result.out.empty());
  }
}

TEST_CASE("check: how far a mesh is from the triangles that it came from, in edges") {
  // Two squares at a right angle, in triangles and in quads; one node of the quads lies 0.1 off.
  const TemporaryDirectory directory;
  const std::vector<std::array<double, 3>> nodes = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 1, 0}, {1, 1, 0}, {1, 1, 1}};
  write_file(directory / "before.msh",
             msh22(nodes, {"2 2 0 1 1 2 5", "2 2 0 1 1 5 4", "2 2 0 1 2 3 6", "2 2 0 1 2 6 5"}));
  const std::vector<std::string> quads = {"3 2 0 1 1 2 5 4", "3 2 0 1 2 3 6 5"};
  write_file(directory / "on.msh", msh22(nodes, quads));
  std::vector<std::array<double, 3>> moved = nodes;
  moved[5] = {1.1, 1, 1};
  write_file(directory / "off.msh", msh22(moved, quads));
  const auto check = [&](const char* file, const char* most) {
    return run_qmorph({"--check", directory / file, "--against", directory / "before.msh", "--max-distance", most});
  };
  const Result on = check("on.msh", "0.001");
  CAPTURE(on.err);
  CHECK(on.status == 0);
  CHECK(mentions(on.out, "centres 0.000 edges off the surface (at most 0.00)"));
  const Result off = check("off.msh", "0.05");
  CAPTURE(off.err);
  CHECK(off.status == 6);
  CHECK(mentions(off.err, "qmorph: surface 1: 0.0"));
  CHECK(mentions(off.err, "edges off at (1.1, 1, 1), and at most 0.05 is asked for"));
  CHECK(check("off.msh", "0.2").status == 0);
  CHECK(mentions(run_qmorph({"--check", directory / "on.msh", "--max-distance", "1"}).err, "--against FILE"));
  CHECK(run_qmorph({directory / "on.msh", "--against", directory / "before.msh"}).status == 1);
  CHECK(run_qmorph({"--check", directory / "on.msh", "--against", directory / "none.msh"}).status == 2);
}
