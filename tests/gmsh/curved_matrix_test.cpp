// SPDX-License-Identifier: GPL-2.0-or-later
/// Curved models of each order through each version and encoding: what was not converted is identical, entity by entity.

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

namespace occ = ::gmsh::model::occ;
namespace mesh = ::gmsh::model::mesh;

const double kRight = std::acos(0.0);

void group(int dim, const std::vector<int>& entities, int tag, const std::string& name) {
  ::gmsh::model::addPhysicalGroup(dim, entities, tag);
  ::gmsh::model::setPhysicalName(dim, tag, name);
}

/// The wall over an arc around the z axis; 1 is the first surface. \return its tag
int add_wall(double x, double from, double to) {
  const int arc = occ::addCircle(x, 0, 0, 1, -1, from, to);
  ::gmsh::vectorpair out;
  occ::extrude({{1, arc}}, 0, 0, 1, out);
  for (const auto& [dim, tag] : out)
    if (dim == 2) return tag;
  return 0;
}

void finish(int order) {
  mesh::generate(2);
  if (order > 1) mesh::setOrder(order);
}

/// A tube with its ends; the wall and one end in groups, curves and a point, too.
void build_tube(int order) {
  occ::addCylinder(0, 0, 0, 0, 0, 1.5, 0.6);
  occ::synchronize();
  ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.25);
  group(2, {1}, 1, "wall");
  group(2, {1, 2}, 2, "wall and lid");
  group(1, {1, 3}, 3, "rims");
  group(0, {1}, 4, "start of the seam");
  finish(order);
}

/// Two walls that share a curve; the second one is of quads already.
void build_two_walls(int order) {
  const int left = add_wall(0, 0, kRight), right = add_wall(0, kRight, 2 * kRight);
  ::gmsh::vectorpair out;
  std::vector<::gmsh::vectorpair> map;
  occ::fragment({{2, left}}, {{2, right}}, out, map);
  occ::synchronize();
  ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.25);
  const int quads = map[1][0].second;
  ::gmsh::vectorpair curves;
  ::gmsh::model::getBoundary({{2, quads}}, curves, false, false, false);
  for (const auto& [dim, tag] : curves) mesh::setTransfiniteCurve(tag, 7);
  mesh::setTransfiniteSurface(quads);
  mesh::setRecombine(2, quads);
  finish(order);
}

/// A wall and its image.
void build_periodic_walls(int order) {
  const int wall = add_wall(0, 0, kRight), image = add_wall(4, 0, kRight);
  occ::synchronize();
  ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.2);
  mesh::setPeriodic(2, {image}, {wall}, {1, 0, 0, 4, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  finish(order);
}

void build_partitioned_ring(int order) {
  occ::addTorus(0, 0, 0, 1, 0.4);
  occ::synchronize();
  ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.25);
  finish(order);
  mesh::partition(3);
}

struct Model {
  const char* name;
  std::function<void(int)> build;
  std::set<int> converted;  ///< all if empty
  std::vector<std::string> words;
  std::size_t triangles = 1;        ///< at most, on a surface: one for each piece of it
  bool is_made_by_reading = false;  ///< Gmsh makes what is between partitions when it reads version 2, as it comes
};

const std::vector<Model> kModels = {
    {"the wall of a tube alone", build_tube, {1}, {"--surfaces", "1"}},
    {"all of a tube", build_tube, {}, {}},
    {"a wall beside one of quads", build_two_walls, {1}, {}},
    {"a wall and its image", build_periodic_walls, {}, {}},
    {"a ring in three partitions", build_partitioned_ring, {}, {}, 2, true},
};

std::set<int> surfaces_of(const Snapshot& snapshot) {
  std::set<int> surfaces;
  for (const auto& entity : snapshot.mesh.entities)
    if (entity.dim == 2 && entity.element_count() > 0) surfaces.insert(entity.tag);
  return surfaces;
}

/// How many triangles and quads, of any order; all of one order.
std::pair<std::size_t, std::size_t> count(const Snapshot& snapshot, int surface, int order) {
  std::pair<std::size_t, std::size_t> counts;
  for (const auto& entity : snapshot.mesh.entities)
    for (const auto& block : entity.blocks) {
      if (entity.dim != 2 || entity.tag != surface) continue;
      CHECK(block.order == order);
      (block.corners == 3 ? counts.first : counts.second) += block.tags.size();
    }
  return counts;
}

/// The numbers of partitions that there are.
std::set<std::vector<int>> partitions(const std::string& path) {
  const adapter::Session session;
  adapter::run_logged([&] { ::gmsh::open(path); });
  std::set<std::vector<int>> found;
  ::gmsh::vectorpair entities;
  ::gmsh::model::getEntities(entities, 2);
  for (const auto& [dim, tag] : entities) {
    std::vector<int> numbers;
    ::gmsh::model::getPartitions(dim, tag, numbers);
    found.insert(numbers);
  }
  return found;
}

/// Surfaces that are images of others, each with the number of its pairs of nodes, and how far a pair is off.
double farthest_pair(const std::string& path, std::size_t& pairs) {
  const adapter::Session session;
  adapter::set_option("Mesh.IgnorePeriodicity", 0);
  adapter::run_logged([&] { ::gmsh::open(path); });
  const adapter::ModelMesh model = adapter::read_model_mesh();
  double most = 0;
  pairs = 0;
  for (const adapter::PeriodicLink& link : adapter::read_periodic_links(model))
    for (const auto& [slave, master] : link.nodes) {
      const Eigen::Vector3d step = model.points[model.rows.find(slave)] - model.points[model.rows.find(master)];
      most = std::max(most, (step - Eigen::Vector3d(4, 0, 0)).norm());
      ++pairs;
    }
  return most;
}

}  // namespace

TEST_CASE("curved matrix: what is not converted is identical, of each order, through each version and encoding") {
  for (const Model& model : kModels)
    for (const int order : {1, 2, 3})
      for (const double version : {2.2, 4.1})
        for (const bool binary : {false, true}) {
          CAPTURE(std::string(model.name));
          CAPTURE(order);
          CAPTURE(version);
          CAPTURE(binary);
          const TemporaryDirectory directory;
          make_msh(directory / "in.msh", version, binary, [&] { model.build(order); });
          const Snapshot before = read_snapshot(directory / "in.msh");
          const std::set<int> converted = model.converted.empty() ? surfaces_of(before) : model.converted;
          std::vector<std::string> words = {directory / "in.msh", "-o", directory / "out.msh"};
          words.insert(words.end(), model.words.begin(), model.words.end());
          const Result result = run_qmorph(words);
          CAPTURE(result.err);
          CHECK(result.status == 0);
          const Snapshot after = read_snapshot(directory / "out.msh");
          if (version > 4 || !model.is_made_by_reading) CHECK(difference(before, after, converted) == "");
          for (const int surface : converted) {
            CAPTURE(surface);
            const auto [triangles, quads] = count(after, surface, order);
            CHECK(triangles <= model.triangles);
            CHECK(quads > 4);
          }
        }
}

TEST_CASE("curved matrix: partitions stay") {
  for (const int order : {1, 2})
    for (const double version : {2.2, 4.1}) {
      CAPTURE(order);
      CAPTURE(version);
      const TemporaryDirectory directory;
      make_msh(directory / "in.msh", version, true, [&] { build_partitioned_ring(order); });
      CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).status == 0);
      CHECK(partitions(directory / "in.msh").size() > 3);
      CHECK(partitions(directory / "in.msh") == partitions(directory / "out.msh"));
    }
}

TEST_CASE("curved matrix: the image of a curved surface has its quads, and the link all nodes") {
  for (const int order : {1, 2, 3}) {
    CAPTURE(order);
    const TemporaryDirectory directory;
    make_msh(directory / "in.msh", 4.1, true, [&] { build_periodic_walls(order); });
    CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).status == 0);
    std::size_t pairs = 0;
    CHECK(farthest_pair(directory / "out.msh", pairs) < 1e-9);
    const Snapshot after = read_snapshot(directory / "out.msh");
    std::set<std::size_t> nodes;
    for (const auto& entity : after.mesh.entities)
      for (const auto& block : entity.blocks)
        if (entity.dim == 2) nodes.insert(block.nodes.begin(), block.nodes.end());
    CHECK(2 * pairs == nodes.size());
  }
}

TEST_CASE("curved matrix: from each version into each other") {
  for (const int order : {1, 2})
    for (const double version : {2.2, 4.1}) {
      const TemporaryDirectory directory;
      make_msh(directory / "in.msh", version, false, [&] { build_two_walls(order); });
      CAPTURE(order);
      CAPTURE(version);
      check_formats(directory / "in.msh", {"msh22", "msh3", "msh40", "msh41"}, {1});
    }
}
