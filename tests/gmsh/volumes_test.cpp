/// Models with volumes: removed before, or made after the quads.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <string>

#include "gmsh/compat.hpp"
#include "gmsh/support.hpp"

using namespace qmorph::test;

namespace {

constexpr int kTetrahedron = 4, kPyramid = 7, kTriangle = 2, kQuad = 3;

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

TEST_CASE("volumes: -3 of a mesh without geometry is refused, and nothing is written") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [] {
    ::gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
    ::gmsh::model::occ::synchronize();
    ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.4);
    ::gmsh::model::mesh::generate(2);
  });
  const Result result = run_qmorph({"-3", directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
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
