// SPDX-License-Identifier: GPL-2.0-or-later
// Elements of a volume that are turned over are found, mended, and go back into the model.
#include "gmsh/volumes/solid.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "gmsh/model/put_back.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/volumes/untangle.hpp"
#include "support/rng.hpp"

using namespace qmorph;
using namespace qmorph::adapter;

namespace {

void add_box() {
  ::gmsh::model::add("box");
  ::gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
  ::gmsh::model::occ::synchronize();
}

/// The same in every version of Gmsh, as its own tetrahedra are not.
void build_grid(bool of_hexahedra) {
  add_box();
  for (int curve = 1; curve <= 12; ++curve) ::gmsh::model::mesh::setTransfiniteCurve(curve, 5);
  for (int surface = 1; surface <= 6; ++surface) {
    ::gmsh::model::mesh::setTransfiniteSurface(surface);
    if (of_hexahedra) ::gmsh::model::mesh::setRecombine(2, surface);
  }
  ::gmsh::model::mesh::setTransfiniteVolume(1);
  ::gmsh::model::mesh::generate(3);
}

void build_tetrahedra() { build_grid(false); }
void build_hexahedra() { build_grid(true); }

/// A node of the volume, brought where elements around it are turned over.
void spoil(ModelMesh& mesh, const EntityMesh& volume) {
  mesh.points[mesh.rows.find(volume.node_tags.front())] += Eigen::Vector3d(0.45, 0.4, 0.35);
}

}  // namespace

TEST_CASE("a volume with elements that are turned over is mended by nodes inside it, and nothing else changes") {
  for (const auto& [name, build] : {std::pair("tetrahedra", std::function(build_tetrahedra)),
                                    std::pair("hexahedra", std::function(build_hexahedra))}) {
    CAPTURE(std::string(name));
    const Session session;
    build();
    ModelMesh mesh = read_model_mesh();
    const EntityMesh& volume = *find_entity(mesh, 3, 1);
    CHECK(find_turned(read_solid(mesh, volume)).empty());
    spoil(mesh, volume);
    Solid solid = read_solid(mesh, volume);
    CHECK(solid.loose_faces == 0);
    const std::vector<std::size_t> turned = find_turned(solid);
    REQUIRE_FALSE(turned.empty());
    CHECK(untangle(solid, turned).empty());

    const EntityMesh mended = with_solid(mesh, volume, solid);
    put_back(mesh, {{std::uint32_t(&volume - mesh.entities.data()), &mended}});
    const ModelMesh after = read_model_mesh();
    const EntityMesh& now = *find_entity(after, 3, 1);
    CHECK(find_turned(read_solid(after, now)).empty());
    CHECK(now.element_count() == volume.element_count());
    CHECK(after.tags == mesh.tags);
    for (Index row = 0; row < after.points.size(); ++row)
      if (&mesh.entities[mesh.owner[row]] != &volume) CHECK(after.points[row] == mesh.points[row]);
  }
}

TEST_CASE("elements that are turned over are mended among thin ones, too") {
  const Session session;
  build_tetrahedra();
  ModelMesh mesh = read_model_mesh();
  const EntityMesh& volume = *find_entity(mesh, 3, 1);
  const std::vector<Eigen::Vector3d> before = mesh.points;
  std::size_t least = 1000, mended = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    test::Rng rng(seed);
    mesh.points = before;
    for (std::size_t tag : volume.node_tags)
      for (double& x : mesh.points[mesh.rows.find(tag)]) x += rng.between(-1, 1);
    for (auto& p : mesh.points)
      p.x() = std::copysign(std::pow(std::abs(p.x()), 9), p.x());  // thinner and thinner layers
    Solid solid = read_solid(mesh, volume);
    const std::vector<std::size_t> turned = find_turned(solid);
    least = std::min(least, turned.size());
    mended += untangle(solid, turned).empty();
  }
  CHECK(least > 20);
  CHECK(mended == 20);
}

TEST_CASE("faces inside a volume that only one element has are counted") {
  const Session session;
  build_hexahedra();
  const ModelMesh mesh = read_model_mesh();
  EntityMesh volume = *find_entity(mesh, 3, 1);
  ElementBlock& block = volume.blocks.front();
  // Without its first cell, which lies in a corner of the box, three faces inside have one side only.
  block.tags.erase(block.tags.begin());
  block.nodes.erase(block.nodes.begin(), block.nodes.begin() + 8);
  CHECK(read_solid(mesh, volume).loose_faces == 3);
}
