// SPDX-License-Identifier: GPL-2.0-or-later
/// Models with volumes: removed before, or made after the quads.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <string>

#include "gmsh/session/compat.hpp"
#include "gmsh/support.hpp"

using namespace qmorph::test;

namespace {

constexpr int kTetrahedron = 4, kHexahedron = 5, kPrism = 6, kPyramid = 7, kTriangle = 2, kQuad = 3;

constexpr const char* kBox =
    "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\nMesh.MeshSizeMax = 0.4;\n"
    "Physical Volume(\"body\", 3) = {1};\nPhysical Surface(\"skin\", 4) = {1:6};\n";

std::map<int, std::size_t> count_types(const Snapshot& snapshot) {
  std::map<int, std::size_t> counts;
  for (const auto& entity : snapshot.mesh.entities)
    for (const auto& block : entity.blocks) counts[block.type] += block.tags.size();
  return counts;
}

}  // namespace

TEST_CASE("volumes: -3 meshes them on the quads, with a pyramid on each") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kBox);
  // A process of its own: Gmsh 4.8 crashes when it makes pyramids for the second time after a finalize().
  CHECK(std::system(fmt::format("'{}' -v 0 -3 '{}'", QMORPH_COMMAND, directory / "in.geo").c_str()) == 0);
  const auto counts = count_types(read_snapshot(directory / "in.msh"));
  CHECK(counts.at(kQuad) == counts.at(kPyramid));
  CHECK(counts.at(kTetrahedron) > 0);
  CHECK(counts.count(kTriangle) == 0);
}

TEST_CASE("volumes: -3 works without a geometry, also where tetrahedra are dropped before") {
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const TemporaryDirectory directory;
    write_file(directory / "in.geo", kBox);
    make_msh(directory / "in.msh", 4.1, false, [&] {
      ::gmsh::merge(directory / "in.geo");
      ::gmsh::model::mesh::generate(dimension);
    });
    const std::string command = fmt::format("'{}' -v 0 -3 --drop-volumes '{}' -o '{}'", QMORPH_COMMAND,
                                            directory / "in.msh", directory / "out.msh");
    REQUIRE(std::system(command.c_str()) == 0);
    const Snapshot in = read_snapshot(directory / "in.msh"), out = read_snapshot(directory / "out.msh");
    const auto counts = count_types(out);
    CHECK(counts.at(kQuad) == counts.at(kPyramid));
    CHECK(counts.at(kTetrahedron) > 0);
    CHECK(counts.count(kTriangle) == 0);
    CHECK(in.groups == out.groups);
    CHECK(out.groups.at({3, 3}) == Snapshot::Group{"body", {1}});
  }
}

TEST_CASE("volumes: quads between two volumes get a pyramid on each side") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo",
             "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\nBox(2) = {1, 0, 0, 1, 1, 1};\nCoherence;\n"
             "Mesh.MeshSizeMax = 0.4;\n");
  REQUIRE(std::system(
              fmt::format("'{}' -3 '{}' 2> '{}'", QMORPH_COMMAND, directory / "in.geo", directory / "err").c_str()) ==
          0);
  const Snapshot out = read_snapshot(directory / "in.msh");
  const auto counts = count_types(out);
  const std::size_t between = element_counts(out, 2).second;  // surface 2 is at x = 1
  CHECK(between > 0);
  CHECK(counts.at(kPyramid) == counts.at(kQuad) + between);
  CHECK(read_file(directory / "err")
            .find(fmt::format("2 volumes: {} pyramids, {} tetrahedra", counts.at(kPyramid), counts.at(kTetrahedron))) !=
        std::string::npos);
}

TEST_CASE("volumes: extruded in layers without Recombine, the message says what is missing") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo",
             "SetFactory(\"OpenCASCADE\");\nDisk(1) = {0, 0, 0, 1};\nMesh.MeshSizeMax = 0.5;\n"
             "Extrude{0, 0, 2}{ Surface{1}; Layers{6}; }\n");
  const int status = std::system(
      fmt::format("'{}' -v 0 -3 '{}' 2> '{}'", QMORPH_COMMAND, directory / "in.geo", directory / "err").c_str());
  CHECK(WEXITSTATUS(status) == 2);
  CHECK(read_file(directory / "err").find("needs Recombine in its Extrude") != std::string::npos);
  CHECK(directory.files() == std::vector<std::string>{"err", "in.geo"});
}

TEST_CASE("volumes: where quads are improved, extruded volumes get their hexahedra all the same") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo",
             "SetFactory(\"OpenCASCADE\");\nDisk(1) = {3, 0, 0, 1};\nMesh.MeshSizeMax = 0.3;\n"
             "Extrude{{0.1, 1, 0.2}, {0, 0, 0}, 1.1}{ Surface{1}; Layers{4}; Recombine; }\n");
  for (const char* how : {"", "--cleanup-only"}) {
    CAPTURE(how);
    CHECK(std::system(fmt::format("'{}' -v 0 -3 {} '{}'", QMORPH_COMMAND, how, directory / "in.geo").c_str()) == 0);
    const auto counts = count_types(read_snapshot(directory / "in.msh"));
    CHECK(counts.at(kHexahedron) > 0);
    for (const int other : {kTriangle, kTetrahedron, kPyramid}) CHECK(counts.count(other) == 0);
  }
}

TEST_CASE("volumes: -3 names a surface without elements") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kBox);
  make_msh(directory / "in.msh", 4.1, false, [&] {
    ::gmsh::merge(directory / "in.geo");
    ::gmsh::model::mesh::generate(2);
    ::gmsh::model::mesh::clear({{2, 4}});
  });
  const Result result = run_qmorph({"-3", directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(result.err == "qmorph: volume 1 cannot be meshed: its surface 4 has no elements\n");
  CHECK(result.status == 2);
}

TEST_CASE("volumes: -3 says what it needs where the file does not say which surfaces a volume has") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 2.2, false, [] {
    ::gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
    ::gmsh::model::occ::synchronize();
    ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.4);
    ::gmsh::model::mesh::generate(3);
  });
  const Result result = run_qmorph({"-3", "--drop-volumes", directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(result.err == "qmorph: the file does not say what surfaces volume 1 has; with MSH 4.1 it would\n");
  CHECK(result.status == 2);
  CHECK(directory.files() == std::vector<std::string>{"in.msh"});
}

TEST_CASE("volumes: --drop-volumes removes their elements and converts the surfaces") {
  for (const double version : {2.2, 4.1}) {
    CAPTURE(version);
    const TemporaryDirectory directory;
    make_msh(directory / "in.msh", version, false, [] {
      ::gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
      ::gmsh::model::occ::synchronize();
      ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.4);
      ::gmsh::model::mesh::generate(3);
    });
    const Result result = run_qmorph({directory / "in.msh", "--drop-volumes", "-o", directory / "out.msh"});
    CAPTURE(result.err);
    CHECK(result.status == 0);
    const auto counts = count_types(read_snapshot(directory / "out.msh"));
    CHECK(counts.count(kTetrahedron) == 0);
    CHECK(counts.count(kTriangle) == 0);
    CHECK(counts.at(kQuad) > 0);
  }
}

namespace {

/// `qmorph -3` on a script, in a process of its own. \return what is in the mesh
std::map<int, std::size_t> mesh_in_space(const std::string& script, int wanted_status = 0) {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", script);
  const int status = std::system(
      fmt::format("'{}' -v 0 -3 '{}' 2> '{}'", QMORPH_COMMAND, directory / "in.geo", directory / "err").c_str());
  CAPTURE(read_file(directory / "err"));
  REQUIRE(WEXITSTATUS(status) == wanted_status);
  return count_types(read_snapshot(directory / "in.msh"));
}

/// A square with a round hole, which no grid fits.
constexpr const char* kHoled =
    "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {1, 0, 0, 1, 1};\nDisk(2) = {1.5, 0.45, 0, 0.21};\n"
    "BooleanDifference{ Surface{1}; Delete; }{ Surface{2}; Delete; }\nMesh.MeshSizeMax = 0.1;\n";

}  // namespace

TEST_CASE("volumes: extruded surfaces with curved walls become hexahedra, whatever the motion") {
  for (const std::string motion : {"{0, 0, 1}", "{0.371, 0.4913, 0.77}", "{{0, 1, 0}, {0, 0, 0}, 1.234}"}) {
    CAPTURE(motion);
    const auto counts =
        mesh_in_space(fmt::format("{}Extrude{}{{ Surface{{1}}; Layers{{3}}; Recombine; }}\n", kHoled, motion));
    CHECK(counts.at(kHexahedron) > 150);
    CHECK(counts.count(kTriangle) + counts.count(kTetrahedron) + counts.count(kPyramid) + counts.count(kPrism) == 0);
  }
}

TEST_CASE("volumes: extruded surfaces on top of each other, and in a ring, fit together") {
  const std::string quarter = "{{0, 1, 0}, {0, 0, 0}, Pi/2}";
  std::string pile = kHoled;
  pile += fmt::format("a[] = Extrude{}{{ Surface{{1}}; Layers{{4}}; Recombine; }};\n", quarter);
  pile += fmt::format("b[] = Extrude{}{{ Surface{{a[0]}}; Layers{{4}}; Recombine; }};\n", quarter);
  pile += fmt::format("c[] = Extrude{}{{ Surface{{b[0]}}; Layers{{4}}; Recombine; }};\n", quarter);
  const auto counts = mesh_in_space(pile);
  CHECK(counts.at(kHexahedron) % 12 == 0);
  CHECK(counts.count(kTriangle) + counts.count(kTetrahedron) + counts.count(kPyramid) == 0);
}

TEST_CASE("volumes: above a triangle that an odd boundary leaves there are prisms") {
  const auto counts = mesh_in_space(
      "Point(1) = {0, 0, 0, 0.2};\nPoint(2) = {1, 0, 0, 0.2};\nPoint(3) = {0, 1, 0, 0.2};\nCircle(1) = {2, 1, 3};\n"
      "Line(2) = {3, 1};\nLine(3) = {1, 2};\nTransfinite Curve{1} = 8;\nTransfinite Curve{2, 3} = 6;\n"
      "Curve Loop(1) = {1, 2, 3};\nPlane Surface(1) = {1};\n"
      "Extrude{{0.1, 0.7, 0.3}, {0.1, 0.7, 0.3}, {-3, 0, 1}, 0.7}{ Surface{1}; Layers{4}; Recombine; }\n");
  CHECK(counts.at(kPrism) == 4);
  CHECK(counts.at(kHexahedron) > 40);
}
