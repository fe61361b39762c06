// SPDX-License-Identifier: GPL-2.0-or-later
/// Surfaces of a geometry face the way that its normals point.
#include "gmsh/read/facing.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"

using namespace qmorph;
using namespace qmorph::test;
using adapter::face_as_geometry;

namespace {

/// A flat ellipsoid with a bowl in it: surface 1 outside and surface 2, the bowl, both with a seam.
constexpr const char* kBowl = R"(SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, 1};
Dilate {{0, 0, 0}, {2, 1, 0.3}} { Volume{1}; }
Sphere(2) = {0, 0, 0.2, 0.6};
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
)";

void open_bowl(const TemporaryDirectory& directory) {
  write_file(directory / "bowl.geo", kBowl);
  ::gmsh::open(directory / "bowl.geo");
}

/// By surface, six times the volume between it and the origin: positive where elements face away from that.
std::map<int, double> volumes(const adapter::ModelMesh& mesh) {
  std::map<int, double> volumes;
  for (const adapter::EntityMesh& entity : mesh.entities) {
    if (entity.dim != 2) continue;
    for (const adapter::ElementBlock& block : entity.blocks)
      for (std::size_t e = 0; e < block.tags.size(); ++e) {
        const auto at = [&](std::size_t i) { return mesh.points[mesh.rows.find(block.nodes[block.corners * e + i])]; };
        for (std::size_t i = 1; i + 1 < block.corners; ++i) volumes[entity.tag] += at(0).dot(at(i).cross(at(i + 1)));
      }
  }
  return volumes;
}

bool face_outwards(const adapter::ModelMesh& mesh) {
  std::map<int, double> found = volumes(mesh);
  return found.size() == 2 && found[1] > 0 && found[2] < 0;
}

std::vector<std::size_t> element_tags(const adapter::ModelMesh& mesh) {
  std::vector<std::size_t> tags;
  for (const adapter::EntityMesh& entity : mesh.entities)
    for (const adapter::ElementBlock& block : entity.blocks)
      tags.insert(tags.end(), block.tags.begin(), block.tags.end());
  return tags;
}

bool is_visible(int dim, int tag) {
  int visible = -1;
  ::gmsh::model::getVisibility(dim, tag, visible);
  return visible != 0;
}

}  // namespace

TEST_CASE("facing: what faces against the geometry is turned over in place, and nothing else is") {
  const RunningGmsh gmsh;
  const TemporaryDirectory directory;
  open_bowl(directory);
  ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.3);
  ::gmsh::model::mesh::generate(2);
  REQUIRE(face_outwards(adapter::read_model_mesh()));
  CHECK(face_as_geometry({1, 2}, {}).empty());

  ::gmsh::model::mesh::setReverse(2, 1, true);
  ::gmsh::model::mesh::generate(2);
  ::gmsh::model::setVisibility({{2, 2}, {1, 1}}, 0);
  const adapter::ModelMesh wrong = adapter::read_model_mesh();
  REQUIRE_FALSE(face_outwards(wrong));
  CHECK(face_as_geometry({1, 2}, {1}).empty());  // as it was asked for
  CHECK(face_as_geometry({2}, {}).empty());
  CHECK(face_as_geometry({1, 2}, {}) == std::vector<int>{1});
  const adapter::ModelMesh right = adapter::read_model_mesh();
  CHECK(face_outwards(right));
  CHECK(element_tags(right) == element_tags(wrong));
  CHECK(right.tags == wrong.tags);
  CHECK_FALSE(is_visible(2, 2));
  CHECK_FALSE(is_visible(1, 1));
  CHECK(is_visible(2, 1));
  for (const adapter::EntityMesh& entity : wrong.entities)
    if (const adapter::EntityMesh* now = find_entity(right, entity.dim, entity.tag); entity.dim == 1 && now)
      CHECK(now->blocks.front().nodes == entity.blocks.front().nodes);
}

TEST_CASE("facing: a model without elements, and one without a geometry, stay as they are") {
  const RunningGmsh gmsh;
  const TemporaryDirectory directory;
  open_bowl(directory);
  CHECK(face_as_geometry({1, 2}, {}).empty());
  ::gmsh::clear();
  build_two_squares();
  CHECK(face_as_geometry({1, 2}, {}).empty());
}

TEST_CASE("facing: on coarse meshes of surfaces with a seam, all of a solid's surfaces face outwards") {
  const TemporaryDirectory directory;
  {
    const RunningGmsh gmsh;
    open_bowl(directory);
    ::gmsh::write(directory / "bowl.brep");
  }
  // Gmsh's own mesh of surface 1 has been seen to face inwards for some of them.
  for (const std::string size : {"0.57", "0.58", "0.59", "0.6", "0.61"}) {
    CAPTURE(size);
    const Result result = run_qmorph({directory / "bowl.brep", "-clmax", size, "-o", directory / "out.msh"});
    REQUIRE_MESSAGE(result.status == 0, result.err);
    CHECK(face_outwards(read_snapshot(directory / "out.msh").mesh));
  }
}

TEST_CASE("facing: a surface that a script reverses faces the other way, hidden or not") {
  const TemporaryDirectory directory;
  for (const std::string hidden : {"", "Hide {Surface {1};}\n"})
    for (const std::string size : {"0.3", "0.58"}) {
      CAPTURE(size);
      write_file(directory / "in.geo",
                 kBowl + ("Mesh.MeshSizeMax = " + size + ";\nPhysical Surface(7) = {1, 2};\nReverse Surface {1};\n" +
                          hidden + "Mesh.MeshOnlyVisible = 0;\nPrint.GeoOnlyPhysicals = 1;\n"));
      const Result result = run_qmorph({directory / "in.geo", "-o", directory / "out.msh"});
      REQUIRE_MESSAGE(result.status == 0, result.err);
      std::map<int, double> found = volumes(read_snapshot(directory / "out.msh").mesh);
      REQUIRE(found.size() == 2);
      CHECK(found[1] < 0);
      CHECK(found[2] < 0);
    }
}
