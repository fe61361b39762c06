// SPDX-License-Identifier: GPL-2.0-or-later
/// Geometries: meshed by Gmsh on the way, with even boundaries, with the options of a gmsh command line.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

constexpr const char* kRectangle = R"(SetFactory("OpenCASCADE");
DefineConstant[length = 1];
Rectangle(1) = {0, 0, 0, length, 1};
Physical Curve("bottom", 3) = {1};
Physical Surface("plate", 4) = {1};
)";

/// Built-in kernel: two squares that share a line. 1 is transfinite; both are to be recombined.
constexpr const char* kFlagged = R"(
Point(1) = {0, 0, 0, 0.2}; Point(2) = {1, 0, 0, 0.2}; Point(3) = {1, 1, 0, 0.2};
Point(4) = {0, 1, 0, 0.2}; Point(5) = {2, 0, 0, 0.2}; Point(6) = {2, 1, 0, 0.2};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {2, 5}; Line(6) = {5, 6}; Line(7) = {6, 3};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, -2}; Plane Surface(2) = {2};
Transfinite Surface {1};
Recombine Surface {1, 2};
)";

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

double largest_x(const Snapshot& snapshot) {
  double x = 0;
  for (const auto& p : snapshot.mesh.points) x = std::max(x, p.x());
  return x;
}

std::size_t nodes_of_curve(const Snapshot& snapshot, int tag) {
  for (const auto& entity : snapshot.mesh.entities)
    if (entity.dim == 1 && entity.tag == tag) return entity.node_tags.size();
  return 0;
}

}  // namespace

TEST_CASE("geometry: no triangle is left, whatever the size") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kRectangle);
  for (const char* size : {"0.37", "0.21", "0.143", "0.09"}) {
    CAPTURE(size);
    const Result result = run_qmorph({directory / "in.geo", "-clmax", size});
    CAPTURE(result.err);
    CHECK(result.status == 0);
    CHECK(element_counts(read_snapshot(directory / "in.msh"), 1).first == 0);
  }
}

TEST_CASE("geometry: physical groups and names are there; what is in no group is left out, as Gmsh does") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kRectangle);
  REQUIRE(run_qmorph({directory / "in.geo", "-clmax", "0.2"}).status == 0);
  const Snapshot after = read_snapshot(directory / "in.msh");
  CHECK(after.groups.at({1, 3}) == Snapshot::Group{"bottom", {1}});
  CHECK(after.groups.at({2, 4}) == Snapshot::Group{"plate", {1}});
  for (const auto& entity : after.mesh.entities)
    if (entity.dim == 1) CHECK((entity.element_count() > 0) == (entity.tag == 1));
  // Numbers without gaps: nobody had seen them before.
  CHECK(after.mesh.max_node_tag == after.mesh.tags.size());
}

TEST_CASE("geometry: -setnumber, -clscale, -clmin and -algo reach Gmsh") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kRectangle);
  const auto run = [&](std::vector<std::string> options) {
    options.insert(options.begin(), directory / "in.geo");
    CHECK(run_qmorph(options).status == 0);
    return read_snapshot(directory / "in.msh");
  };
  CHECK(largest_x(run({"-setnumber", "length", "2.5"})) == doctest::Approx(2.5));
  const std::size_t coarse = nodes_of_curve(run({"-setnumber", "Mesh.MeshSizeMax", "0.2"}), 1);
  CHECK(nodes_of_curve(run({"-setnumber", "Mesh.MeshSizeMax", "0.2", "-clscale", "0.5"}), 1) > coarse);
  CHECK(nodes_of_curve(run({"-clmax", "0.2", "-clmin", "0.1"}), 1) == coarse);
  run({"-clmax", "0.2", "-algo", "del2d"});
  run({"-2", "-clmax", "0.2", "-algo", "MeshAdapt", "-setstring", "name", "x"});
}

TEST_CASE("geometry: an option that Gmsh does not have is reported") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kRectangle);
  const Result result = run_qmorph({directory / "in.geo", "-clmax", "0.3", "-setnumber", "Mesh.Whatever", "3",
                                    "-setnumber", "Mesh.Smoothing", "2", "-setstring", "General.DefaultFileName", "x"});
  CHECK(result.status == 0);
  CHECK(mentions(result.err, "warning: this Gmsh has no option Mesh.Whatever\n"));
  CHECK(!mentions(result.err, "Mesh.Smoothing"));
  CHECK(!mentions(result.err, "General.DefaultFileName"));
}

TEST_CASE("geometry: transfinite surfaces that are to be recombined come as Gmsh's quads, others as ours") {
  for (const std::string extra : {"", "Mesh.RecombineAll = 1;\n", "Mesh.SubdivisionAlgorithm = 1;\n"}) {
    CAPTURE(extra);
    const TemporaryDirectory directory;
    write_file(directory / "in.geo", kFlagged + extra);
    const Result result = run_qmorph({directory / "in.geo"});
    CAPTURE(result.err);
    CHECK(result.status == 0);
    CHECK(mentions(result.err, "surface 1: 25 quads already"));
    CHECK(mentions(result.err, "surface 2: 68 triangles -> "));
    const Snapshot after = read_snapshot(directory / "in.msh");
    CHECK(element_counts(after, 1) == std::pair<std::size_t, std::size_t>{0, 25});
    CHECK(element_counts(after, 2).first == 0);
  }
}

TEST_CASE("geometry: a script that has meshed itself is not meshed again") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", std::string(kRectangle) + "Mesh.MeshSizeMax = 0.25;\nMesh 2;\n");
  const Result result = run_qmorph({directory / "in.geo", "--stats", directory / "stats.json"});
  CHECK(result.status == 0);
  CHECK(mentions(read_file(directory / "stats.json"), "\"mesh\": 0.0"));
}

TEST_CASE("geometry: a script that has partitioned its mesh keeps mesh and partitions") {
  for (const std::string topology : {"1", "0"}) {
    CAPTURE(topology);
    const TemporaryDirectory directory;
    write_file(directory / "in.geo", std::string(kRectangle) + "Mesh.MeshSizeMax = 0.1;\nMesh 2;\n" +
                                         "Mesh.PartitionCreateTopology = " + topology + ";\nPartitionMesh 3;\n");
    const Result result = run_qmorph({directory / "in.geo", "-o", directory / "out.msh"});
    CAPTURE(result.err);
    CHECK(result.status == 0);
    CHECK(mentions(read_file(directory / "out.msh"), "$PartitionedEntities"));
  }
}

TEST_CASE("geometry: STEP and BREP") {
  const TemporaryDirectory directory;
  {
    const adapter::Session session;
    ::gmsh::model::occ::addRectangle(0, 0, 0, 1, 1, 1);
    ::gmsh::model::occ::synchronize();
    ::gmsh::write(directory / "a.brep");
    ::gmsh::write(directory / "b.step");
  }
  for (const std::string name : {"a.brep", "b.step"}) {
    CAPTURE(name);
    const Result result = run_qmorph({directory / name, "-o", directory / "out.msh", "-clmax", "0.1"});
    CAPTURE(result.err);
    CHECK(result.status == 0);
  }
}

TEST_CASE("geometry: formats by name and by extension") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kRectangle);
  const auto run = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {directory / "in.geo", "-clmax", "0.2"});
    const Result result = run_qmorph(options);
    CAPTURE(result.err);
    CHECK(result.status == 0);
  };
  run({"-format", "msh2"});
  CHECK(read_file(directory / "in.msh").substr(0, 17) == "$MeshFormat\n2.2 0");
  run({"-format", "vtk"});
  CHECK(mentions(read_file(directory / "in.vtk"), "CELL_TYPES"));
  run({"-format", "vtk", "-o", directory / "z.msh"});  // -format wins, as with Gmsh
  CHECK(mentions(read_file(directory / "z.msh"), "CELL_TYPES"));
  run({"-bin", "-o", directory / "b.msh"});
  CHECK(read_file(directory / "b.msh").substr(0, 17) == "$MeshFormat\n4.1 1");
  run({"-o", directory / "c.msh2"});
  CHECK(read_file(directory / "c.msh2").substr(0, 17) == "$MeshFormat\n2.2 0");
  run({"-o", directory / "d.inp"});
  CHECK(mentions(read_file(directory / "d.inp"), "CPS4"));
  run({"-o", directory / "e.su2"});
  CHECK(mentions(read_file(directory / "e.su2"), "NDIME= 2"));
  run({"-setnumber", "Mesh.MshFileVersion", "2.2", "-o", directory / "f.msh"});
  CHECK(read_file(directory / "f.msh").substr(0, 17) == "$MeshFormat\n2.2 0");
}

TEST_CASE("geometry: a file without surfaces") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", "Point(1) = {0, 0, 0, 1};\nPoint(2) = {1, 0, 0, 1};\nLine(1) = {1, 2};\n");
  const Result result = run_qmorph({directory / "in.geo"});
  CHECK(result.status == 4);
  CHECK(mentions(result.err, "has no surface with elements"));
  CHECK(directory.files() == std::vector<std::string>{"in.geo"});
}

TEST_CASE("geometry: surfaces that a Compound Surface joins are converted one by one") {
  const TemporaryDirectory directory;
  write_file(
      directory / "in.geo",
      "Point(1)={0,0,0,.2}; Point(2)={1,0,0,.2}; Point(3)={1,1,0,.2}; Point(4)={0,1,0,.2};\n"
      "Point(5)={2,0,0,.2}; Point(6)={2,1,0,.2};\n"
      "Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1}; Line(5)={2,5}; Line(6)={5,6}; Line(7)={6,3};\n"
      "Curve Loop(1)={1,2,3,4}; Plane Surface(1)={1}; Curve Loop(2)={5,6,7,-2}; Plane Surface(2)={2};\n"
      "Compound Surface{1,2};\n");
  const Result result = run_qmorph({directory / "in.geo"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  const Snapshot after = read_snapshot(directory / "in.msh");
  for (int surface : {1, 2}) CHECK(element_counts(after, surface).first == 0);
}

TEST_CASE("geometry: a narrow surface of a compound may get no element, which is reported") {
  // The geometry of Gmsh's tutorial t12 in short.
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", R"(
    Point(1) = {0, 0, 0, 0.1}; Point(2) = {1, 0, 0, 0.1}; Point(3) = {1, 1, 0, 0.1}; Point(4) = {0, 1, 0, 0.1};
    Point(6) = {0, 0.01, 0, 0.1}; Point(8) = {1, 0.02, 0, 0.1};
    Line(1) = {1, 2}; Line(2) = {2, 8}; Line(4) = {8, 3}; Line(5) = {3, 4}; Line(6) = {4, 6}; Line(8) = {6, 1};
    Line(10) = {6, 8};
    Curve Loop(1) = {4, 5, 6, 10}; Plane Surface(1) = {1}; Curve Loop(2) = {1, 2, -10, 8}; Plane Surface(2) = {2};
    Compound Curve{2, 4}; Compound Curve{6, 8}; Compound Surface{1, 2};
  )");
  const Result result = run_qmorph({directory / "in.geo", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  CHECK(result.err.find("Gmsh gave no element of a compound to surfaces 2") != std::string::npos);
}

TEST_CASE("geometry: a request for homology does not stop the meshing") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo",
             "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\nPhysical Surface(1) = {1};\n"
             "Homology {{1}, {}};\n");
  const Result result = run_qmorph({directory / "in.geo", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
}

TEST_CASE("geometry: surfaces made of facets are meshed with the sizes that the script asks for") {
  const TemporaryDirectory directory;
  // A box of 4 x 2 x 1 in twelve facets.
  const double size[3] = {4, 2, 1};
  std::string stl = "solid box\n";
  for (int axis : {0, 1, 2})
    for (int side : {0, 1}) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      const auto corner = [&](int i, int j) {
        double p[3];
        p[axis] = side * size[axis], p[a] = i * size[a], p[b] = j * size[b];
        return "vertex " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
      };
      for (int half : {0, 1}) {
        const std::string first = corner(half, half), last = corner(1 - half, 1 - half);
        const std::string middle = side ? corner(1 - half, half) : corner(half, 1 - half);
        stl += "facet normal 0 0 0\nouter loop\n" + first + middle + last + "endloop\nendfacet\n";
      }
    }
  write_file(directory / "box.stl", stl + "endsolid\n");
  for (const std::string extra : {"", "Recombine Surface{:};\n"}) {
    CAPTURE(extra);
    write_file(directory / "in.geo",
               "Merge \"box.stl\";\nClassifySurfaces{40 * Pi / 180, 1, 1, Pi};\nCreateGeometry;\n" + extra +
                   "Mesh.MeshSizeMin = 0.25;\nMesh.MeshSizeMax = 0.25;\n");
    const Result result = run_qmorph({directory / "in.geo"});
    CAPTURE(result.err);
    CHECK(result.status == 0);
    CHECK(!mentions(result.err, "quads already"));
    std::size_t quads = 0;
    const Snapshot after = read_snapshot(directory / "in.msh");
    for (const auto& entity : after.mesh.entities)
      if (const auto* block = entity.block(adapter::kQuad4)) quads += block->tags.size();
    CHECK(quads > 28 * 16 / 2);  // the area is 28
    CHECK(quads < 28 * 16 * 2);
  }
}

TEST_CASE("geometry: a fillet much narrower than the size, with a node in the middle of its ends, becomes rows") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", R"(SetFactory("OpenCASCADE");
    Circle(1) = {0, 0, 0, 2.09, 0, 1.06}; Extrude{0, 0, 45} { Curve{1}; }
    Mesh.MeshSizeMin = 9; Mesh.MeshSizeMax = 9;)");
  REQUIRE(run_qmorph({directory / "in.geo", "-o", directory / "out.msh", "--stats", directory / "out.json"}).status ==
          0);
  const auto total = nlohmann::json::parse(read_file(directory / "out.json"))["total"];
  CHECK(total["quads"] == 10);
  CHECK(total["scaled_jacobian"]["min"].get<double>() > 0.95);  // leaning quads without irregular nodes: 0.23
}

TEST_CASE("geometry: what a script has meshed stays, and what it makes afterwards is meshed") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo",
             "SetFactory(\"OpenCASCADE\");\nMesh.MeshSizeMax = 0.05;\nRectangle(1) = {0, 0, 0, 1, 1};\nMesh 2;\n"
             "Rectangle(2) = {3, 0, 0, 1, 1};\nMesh.MeshSizeMax = 0.125;\n");
  const Result result = run_qmorph({directory / "in.geo"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  const Snapshot after = read_snapshot(directory / "in.msh");
  CHECK(element_counts(after, 1) == std::pair<std::size_t, std::size_t>(0, 400));
  CHECK(element_counts(after, 2) == std::pair<std::size_t, std::size_t>(0, 64));
}
