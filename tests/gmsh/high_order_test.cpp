// SPDX-License-Identifier: GPL-2.0-or-later
/// Elements of second and higher order, from files and from geometries.

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <string>

#include "gmsh/session/compat.hpp"
#include "gmsh/support.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

/// A disk (surface 1) and a square of quads (3) beside a square of triangles (2).
void build_disk_and_squares(int order, bool incomplete) {
  namespace occ = ::gmsh::model::occ;
  const int disk = occ::addDisk(0, 0, 0, 1, 1);
  const int left = occ::addRectangle(2, -1, 0, 2, 2), right = occ::addRectangle(4, -1, 0, 1, 2);
  ::gmsh::vectorpair out;
  std::vector<::gmsh::vectorpair> map;
  occ::fragment({{2, disk}}, {{2, left}, {2, right}}, out, map);
  occ::synchronize();
  ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.3);
  ::gmsh::option::setNumber("Mesh.SecondOrderIncomplete", incomplete);
  ::gmsh::model::mesh::setRecombine(2, right);
  ::gmsh::model::mesh::generate(2);
  ::gmsh::model::mesh::setOrder(order);
}

/// Elements of each type on a surface.
std::map<int, std::size_t> types_of(const Snapshot& snapshot, int surface) {
  std::map<int, std::size_t> counts;
  for (const auto& entity : snapshot.mesh.entities)
    if (entity.dim == 2 && entity.tag == surface)
      for (const auto& block : entity.blocks) counts[block.type] = block.tags.size();
  return counts;
}

/// Every node is used by an element, and no two are at one place.
void check_nodes(const Snapshot& snapshot) {
  std::map<std::size_t, int> uses;
  for (const auto& entity : snapshot.mesh.entities)
    for (const auto& block : entity.blocks)
      for (std::size_t tag : block.nodes) ++uses[tag];
  CHECK(uses.size() == snapshot.mesh.tags.size());
  std::set<std::array<double, 3>> places;
  for (const auto& p : snapshot.mesh.points) places.insert({p.x(), p.y(), p.z()});
  CHECK(places.size() == snapshot.mesh.points.size());
}

constexpr int kTriangle6 = 9, kQuad9 = 10, kQuad8 = 16, kQuad16 = 36, kTriangle10 = 21;

}  // namespace

TEST_CASE("high order: a mesh keeps its order, in each version and encoding") {
  const struct {
    int order;
    bool incomplete;
    int quad, triangle;
  } kCases[] = {{2, false, kQuad9, kTriangle6}, {2, true, kQuad8, kTriangle6}, {3, false, kQuad16, kTriangle10}};
  for (const auto& the_case : kCases)
    for (const double version : {2.2, 4.1})
      for (const bool binary : {false, true}) {
        CAPTURE(the_case.order);
        CAPTURE(the_case.quad);
        CAPTURE(version);
        CAPTURE(binary);
        const TemporaryDirectory directory;
        make_msh(directory / "in.msh", version, binary,
                 [&] { build_disk_and_squares(the_case.order, the_case.incomplete); });
        const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
        CAPTURE(result.err);
        CHECK(result.status == 0);
        const Snapshot before = read_snapshot(directory / "in.msh"), after = read_snapshot(directory / "out.msh");
        for (int surface : {1, 2}) {
          const auto types = types_of(after, surface);
          CHECK(types.at(the_case.quad) > 20);
          for (const auto& [type, count] : types)
            CHECK((type == the_case.quad || (type == the_case.triangle && count == 1)));
        }
        // Curves and the surface of quads with all their nodes; the sides of the disk stay on the circle.
        CHECK(difference(before, after, {1, 2}) == "");
        check_nodes(after);
      }
}

TEST_CASE("high order: from a geometry, with nodes on it") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", "SetFactory(\"OpenCASCADE\");\nDisk(1) = {0, 0, 0, 1};\nMesh.MeshSizeMax = 0.4;\n");
  for (const bool incomplete : {false, true}) {
    CAPTURE(incomplete);
    const Result result = run_qmorph(
        {directory / "in.geo", "-order", "2", "-setnumber", "Mesh.SecondOrderIncomplete", incomplete ? "1" : "0"});
    CAPTURE(result.err);
    CHECK(result.status == 0);
    const Snapshot after = read_snapshot(directory / "in.msh");
    const auto types = types_of(after, 1);
    CHECK(types.size() == 1);
    CHECK(types.count(incomplete ? kQuad8 : kQuad9) == 1);
    for (const auto& entity : after.mesh.entities)
      for (std::size_t i = 0; entity.dim == 1 && i < entity.node_tags.size(); ++i)
        CHECK(std::abs(std::hypot(entity.xyz[3 * i], entity.xyz[3 * i + 1]) - 1) < 1e-9);
    check_nodes(after);
  }
}

TEST_CASE("high order: an order that the script asks for") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo",
             "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\nMesh.ElementOrder = 2;\n");
  CHECK(run_qmorph({directory / "in.geo"}).status == 0);
  CHECK(types_of(read_snapshot(directory / "in.msh"), 1).count(kQuad9) == 1);
}

TEST_CASE("high order: nodes keep their tags where the order of a mesh is raised or lowered") {
  const TemporaryDirectory directory;
  int from = 1, to = 2;
  SUBCASE("raised") {}
  SUBCASE("lowered") { std::swap(from, to); }
  make_msh(directory / "in.msh", 4.1, false, [&] {
    build_two_squares();
    ::gmsh::model::mesh::setOrder(from);
  });
  CHECK(run_qmorph({directory / "in.msh", "-order", std::to_string(to), "-o", directory / "out.msh"}).status == 0);
  const Snapshot before = read_snapshot(directory / "in.msh"), after = read_snapshot(directory / "out.msh");
  const auto ends_of_lines = [](const Snapshot& snapshot) {
    std::map<std::pair<int, std::size_t>, Eigen::Vector3d> ends;  // by curve and node
    for (const auto& entity : snapshot.mesh.entities)
      for (const auto& block : entity.blocks)
        for (std::size_t i = 0; i < block.nodes.size(); ++i)
          if (entity.dim <= 1 && i % block.nodes_per_element < block.corners)
            ends[{entity.tag, block.nodes[i]}] = snapshot.mesh.points[snapshot.mesh.rows.find(block.nodes[i])];
    return ends;
  };
  CHECK(ends_of_lines(before) == ends_of_lines(after));
}

TEST_CASE("high order: a curved side of the input that inverts a quad, as it did a triangle, is told of") {
  const TemporaryDirectory directory;
  // The lower side leaves its first corner to the left of the side behind it.
  const std::string nodes =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n"
      "5 0.2 0.9 0\n6 1 0.5 0\n7 0.5 0.5 0\n8 0.5 1 0\n9 0 0.5 0\n$EndNodes\n";
  write_file(directory / "in.msh",
             nodes + "$Elements\n2\n1 9 2 0 1 1 2 3 5 6 7\n2 9 2 0 1 1 3 4 7 8 9\n$EndElements\n");
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 3);
  CHECK(result.err.find("qmorph: surface 1: its curved edges turn an element over at (0, 0, 0), as they did triangles "
                        "there; refine the mesh there") != std::string::npos);
  CHECK(result.err.find("left as") == std::string::npos);
  CHECK(types_of(read_snapshot(directory / "out.msh"), 1).count(kQuad9) == 1);
  const Result check = run_qmorph({"--check", directory / "in.msh"});
  CHECK(check.status == 6);
  CHECK(check.err.find("surface 1: a curved edge turns an element over at (0, 0, 0)") != std::string::npos);
}
