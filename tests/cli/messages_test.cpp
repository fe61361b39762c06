// SPDX-License-Identifier: GPL-2.0-or-later
/// What the command says: what is wrong or left, where, and what to do about it.

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"

using namespace qmorph::test;

namespace {

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Three triangles in a pentagon: five sides.
const std::string kPentagon =
    msh22({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}}, {"2 2 0 1 1 2 3", "2 2 0 1 1 3 4", "2 2 0 1 1 4 5"});

/// One quad with a corner of more than 180 degrees.
const std::string kConcave = msh22({{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}}, {"3 2 0 1 1 2 3 4"});

}  // namespace

TEST_CASE("messages: a triangle that an odd boundary forces names --all-quad, and is no failure") {
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", kPentagon);
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(result.status == 0);
  CHECK(mentions(result.err,
                 "1 triangle is left where a boundary has an odd number of sides, on surface 1; --all-quad leaves "
                 "none\n"));
  const Result even = run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--all-quad"});
  CHECK(even.status == 0);
  CHECK(!mentions(even.err, "--all-quad leaves"));
  CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "-v", "0"}).err.empty());
}

TEST_CASE("messages: of many surfaces with a triangle the first ones are named") {
  const TemporaryDirectory directory;
  const Grid grid{.n = 3};
  std::vector<std::string> rows;
  for (const auto& triangle : grid.triangles())
    rows.push_back(row("2 2 0 " + std::to_string(rows.size() + 1), triangle));
  write_file(directory / "in.msh", msh22(grid.nodes(), rows));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(result.status == 0);
  CHECK(mentions(result.err, "18 triangles are left"));
  CHECK(mentions(result.err, "on surfaces 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, ...; --all-quad"));
}

TEST_CASE("messages: a concave quad of the input names --cleanup-only") {
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", kConcave);
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(result.status == 3);
  CHECK(mentions(result.err, "is inverted or not convex at (0.5, 0.5, 0); --cleanup-only"));
}

TEST_CASE("messages: quads that are left as they were count as quads in the total") {
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", kConcave);
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(mentions(result.err, "total: 1 quad -> 1 quad; not measured; "));
  CHECK(!mentions(result.err, "no quad"));
}

TEST_CASE("messages: places on a map, metres from their origin far away, are told apart") {
  const TemporaryDirectory directory;
  // The middle one of three quads in a row is concave, at a node a quarter of a metre from the next one.
  write_file(directory / "in.msh", msh22({{500000.25, 4649776.5, 0},
                                          {500000.5, 4649776.5, 0},
                                          {500000.3125, 4649776.5625, 0},
                                          {500000.25, 4649776.75, 0}},
                                         {"3 2 0 1 1 2 3 4"}));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(result.status == 3);
  CHECK(mentions(result.err, "at (500000.3125, 4649776.5625, 0)"));
}

TEST_CASE("messages: quads whose order changes are not as they were") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo",
             "SetFactory(\"OpenCASCADE\"); Disk(1) = {0, 0, 0, 1}; Mesh.MeshSizeMax = 0.5; Mesh.ElementOrder = 2;\n");
  REQUIRE(run_qmorph({directory / "in.geo", "-o", directory / "quads.msh"}).status == 0);
  const Result result = run_qmorph({directory / "quads.msh", "-order", "1", "-o", directory / "out.msh"});
  CHECK(result.status == 0);
  CHECK(mentions(result.err, "all surfaces are quads already; "));
  CHECK(!mentions(result.err, "as it was"));
}

TEST_CASE("messages: of a word in a script that Gmsh does not know, which version does not know it") {
  const TemporaryDirectory directory;
  write_file(directory / "field.geo", "Field[1] = Tomorrow;\n");
  const Result result = run_qmorph({directory / "field.geo", "-o", directory / "out.msh"});
  CHECK(result.status == 2);
  CHECK(mentions(result.err, "Tomorrow"));
  CHECK(mentions(result.err, "(this is Gmsh 4."));
}

TEST_CASE("messages: what Gmsh says again and again is reported once") {
  qmorph::adapter::StageLog log;
  log.errors = {"no convergence", "no convergence", "a hole", "no convergence", "a leak"};
  CHECK(qmorph::adapter::first_errors(log) == "no convergence; a hole; a leak");
  log.errors.insert(log.errors.end(), {"a twist", "a crack", "a twist"});
  CHECK(qmorph::adapter::first_errors(log) == "no convergence; a hole; a leak (and 2 more)");
}

TEST_CASE("messages: a format that Gmsh was built without, in the same words each time") {
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", kPentagon);
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.med"});
  if (result.status == 0) return;  // this one was built with it
  CHECK(result.status == 5);
  CHECK(!mentions(result.err, "tmp-"));
  CHECK(result.err == run_qmorph({directory / "in.msh", "-o", directory / "out.med"}).err);
}

TEST_CASE("messages: a format that Gmsh only writes is named") {
  const TemporaryDirectory directory;
  write_file(directory / "deck.inp", "*HEADING\n*NODE\n1, 0, 0, 0\n");
  const Result result = run_qmorph({directory / "deck.inp"});
  CHECK(result.status == 2);
  CHECK(mentions(result.err, "does not read .inp files"));
}

TEST_CASE("messages: files that Gmsh takes for scripts, and kinds of a format that its reader does not know") {
  const TemporaryDirectory directory;
  const auto said = [&](const std::string& name, const std::string& text) {
    write_file(directory / name, text);
    const Result result = run_qmorph({directory / name, "-o", directory / "out.msh"});
    CHECK(result.status == 2);
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    return result.err;
  };
  CHECK(mentions(said("in.vtu", "<VTKFile type=\"UnstructuredGrid\">\n"), "does not read .vtu files"));
  CHECK(mentions(said("in.geo", "Point(1 = {};\n"), "syntax error"));
  write_file(directory / "options.msh.opt", "garbage (((\n");
  CHECK(mentions(said("options.msh", kPentagon), "options.msh.opt', line 1: syntax error"));
  CHECK(mentions(said("in.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 3\n"), "it is binary"));
  CHECK(mentions(said("in.stl", "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0,5 0,0 0,0\n"), "decimal commas"));
  CHECK(mentions(said("in.msh", "\xEF\xBB\xBF$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"), "byte order mark"));
  CHECK(mentions(said("in.vtk", "# vtk DataFile Version 5.1\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"),
                 "it is of VTK 5.1: write it as VTK 4.2"));
}

TEST_CASE("messages: data that Gmsh does not read from VTK files") {
  const TemporaryDirectory directory;
  const std::string mesh =
      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
      "CELLS 2 8\n3 0 1 2\n3 0 2 3\nCELL_TYPES 2\n5\n5\n";
  write_file(directory / "plain.vtk", mesh);
  write_file(directory / "data.vtk", mesh + "POINT_DATA 4\nSCALARS t double 1\nLOOKUP_TABLE default\n0 1 2 3\n");
  for (const std::string name : {"plain", "data"}) {
    const Result result = run_qmorph({directory / (name + ".vtk"), "-o", directory / "out.msh"});
    CHECK(result.status == 0);
    CHECK(mentions(result.err, "warning: data on points and cells is left out") == (name == "data"));
  }
}

TEST_CASE("messages: files of a format in which Gmsh finds nothing are no meshes without surfaces") {
  const TemporaryDirectory directory;
  for (const char* name : {"in.unv", "in.brep", "in.mesh", "in.bdf", "in.iges", "in.stl"}) {
    CAPTURE(std::string(name));
    write_file(directory / name, "hello world\n");
    const Result result = run_qmorph({directory / name, "-o", directory / "out.msh"});
    CHECK(result.status == 2);
    // Newer versions of Gmsh say themselves what is wrong with some of them.
    const bool gmsh_says_why = mentions(result.err, "Unknown Medit mesh format");
    CHECK((gmsh_says_why || mentions(result.err, "is it of the format that its name says?")));
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
  }
  write_file(directory / "in.xyz", std::string("\1\0\2", 3));
  CHECK(mentions(run_qmorph({directory / "in.xyz", "-o", directory / "out.msh"}).err, "is binary"));
  write_file(directory / "in.geo", std::string("Point(1)\0 = {0, 0, 0};", 20));
  CHECK(run_qmorph({directory / "in.geo"}).status == 2);
}
