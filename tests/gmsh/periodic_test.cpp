// SPDX-License-Identifier: GPL-2.0-or-later
/// Surfaces that are images of one another stay so.

#include "gmsh/convert/periodic.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

namespace occ = ::gmsh::model::occ;

/// A box with a hole along x: the faces at x = 0 (master) and x = 1.
void build_translated() {
  ::gmsh::vectorpair out;
  std::vector<::gmsh::vectorpair> map;
  occ::addBox(0, 0, 0, 1, 1, 1, 1);
  occ::addCylinder(-1, 0.4, 0.6, 3, 0, 0, 0.2, 2);
  occ::cut({{3, 1}}, {{3, 2}}, out, map);
  occ::synchronize();
  ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.15);
  ::gmsh::vectorpair left, right;
  ::gmsh::model::getEntitiesInBoundingBox(-0.01, -1, -1, 0.01, 2, 2, left, 2);
  ::gmsh::model::getEntitiesInBoundingBox(0.99, -1, -1, 1.01, 2, 2, right, 2);
  ::gmsh::model::mesh::setPeriodic(2, {right[0].second}, {left[0].second},
                                   {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  ::gmsh::model::mesh::generate(2);
}

/// A quarter of a cylinder: its plane sides are 90 degrees apart.
void build_rotated() {
  occ::addCylinder(0, 0, 0, 0, 0, 1, 1, 1, std::acos(-1) / 2);
  occ::synchronize();
  ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.2);
  ::gmsh::vectorpair y0, x0;
  ::gmsh::model::getEntitiesInBoundingBox(-0.01, -0.01, -1, 2, 0.01, 2, y0, 2);
  ::gmsh::model::getEntitiesInBoundingBox(-0.01, -0.01, -1, 0.01, 2, 2, x0, 2);
  ::gmsh::model::mesh::setPeriodic(2, {x0[0].second}, {y0[0].second},
                                   {0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  ::gmsh::model::mesh::generate(2);
}

struct Linked {
  adapter::ModelMesh mesh;
  std::vector<adapter::PeriodicLink> links;
};

Linked read_linked(const std::string& path) {
  const adapter::Session session;
  adapter::set_option("Mesh.IgnorePeriodicity", 0);
  adapter::run_logged([&] { ::gmsh::open(path); });
  Linked linked;
  linked.mesh = adapter::read_model_mesh();
  linked.links = adapter::read_periodic_links(linked.mesh);
  return linked;
}

/// Elements as sets of nodes, with nodes replaced by those that `replace` has for them.
std::set<std::set<std::size_t>> elements_of(const adapter::ModelMesh& mesh, int surface,
                                            const std::map<std::size_t, std::size_t>& replace) {
  std::set<std::set<std::size_t>> elements;
  for (const auto& entity : mesh.entities)
    for (const auto& block : entity.blocks)
      for (std::size_t i = 0; entity.dim == 2 && entity.tag == surface && i < block.nodes.size();
           i += block.nodes_per_element) {
        std::set<std::size_t> element;
        for (std::size_t k = i; k < i + block.nodes_per_element; ++k)
          element.insert(replace.count(block.nodes[k]) ? replace.at(block.nodes[k]) : block.nodes[k]);
        elements.insert(element);
      }
  return elements;
}

void check_image(const Linked& linked) {
  REQUIRE(linked.links.size() == 1);
  const adapter::PeriodicLink& link = linked.links.front();
  std::map<std::size_t, std::size_t> to_master;
  for (const auto& [slave, master] : link.nodes) {
    to_master[slave] = master;
    const Eigen::Vector3d& p = linked.mesh.points[linked.mesh.rows.find(master)];
    const Eigen::Vector3d& q = linked.mesh.points[linked.mesh.rows.find(slave)];
    for (int i = 0; i < 3; ++i) {
      const double* t = link.transformation.data() + 4 * i;
      CHECK(std::abs(t[0] * p.x() + t[1] * p.y() + t[2] * p.z() + t[3] - q[i]) < 1e-9);
    }
  }
  const auto image = elements_of(linked.mesh, link.slave, to_master),
             master = elements_of(linked.mesh, link.master, {});
  CHECK(image == master);
  const auto is_triangle = [](const auto& element) { return element.size() == 3; };
  CHECK(std::count_if(master.begin(), master.end(), is_triangle) <= 1);  // where the boundary is odd
}

/// A square and its image, whose last node is off its place, in a file that pairs the first so many nodes.
std::string two_grids(double off, int pairs) {
  const Grid left, right{.x = 3, .first_node = 26};
  std::vector<std::array<double, 3>> nodes = left.nodes();
  for (const auto& node : right.nodes()) nodes.push_back(node);
  nodes.back()[0] += off;
  std::vector<std::string> elements;
  for (const auto& triangle : left.triangles()) elements.push_back(row("2 2 0 1", triangle));
  for (const auto& triangle : right.triangles()) elements.push_back(row("2 2 0 2", triangle));
  std::string text = msh22(nodes, elements) + "$Periodic\n1\n2 2 1\nAffine 1 0 0 3 0 1 0 0 0 0 1 0 0 0 0 1\n" +
                     std::to_string(pairs) + '\n';
  for (int i = 1; i <= pairs; ++i) text += std::to_string(25 + i) + ' ' + std::to_string(i) + '\n';
  return text + "$EndPeriodic\n";
}

/// Where that node is.
double last_x(const std::string& path) {
  const std::string text = read_file(path);
  return std::stod(text.substr(text.find("\n50 ", text.find("$Nodes")) + 4));
}

}  // namespace

TEST_CASE("periodic: the image of a converted surface is its copy, and the link has all nodes") {
  for (const auto& build : {build_translated, build_rotated})
    for (const double version : {2.2, 4.1})
      for (const bool binary : {false, true}) {
        CAPTURE(version);
        CAPTURE(binary);
        const TemporaryDirectory directory;
        make_msh(directory / "in.msh", version, binary, build);
        REQUIRE(read_linked(directory / "in.msh").links.size() == 1);
        const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
        CAPTURE(result.err);
        CHECK(result.status == 0);
        check_image(read_linked(directory / "out.msh"));
      }
}

TEST_CASE("periodic: surfaces of higher order stay images of one another, with all their nodes") {
  for (const auto& build : {build_translated, build_rotated})
    for (const int order : {2, 3}) {
      CAPTURE(order);
      const TemporaryDirectory directory;
      make_msh(directory / "in.msh", 4.1, false, [&] {
        build();
        ::gmsh::model::mesh::setOrder(order);
      });
      const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
      CAPTURE(result.err);
      const Linked out = read_linked(directory / "out.msh");
      check_image(out);
      for (const auto& entity : out.mesh.entities)
        if (entity.dim == 2 && (entity.tag == out.links.front().slave || entity.tag == out.links.front().master))
          CHECK(entity.polygons(4) != nullptr);
    }
}

TEST_CASE("periodic: from a geometry, and in a running session") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo",
             "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\nMesh.MeshSizeMax = 0.3;\n"
             "Periodic Surface {2} = {1} Translate {1, 0, 0};\n");
  CHECK(run_qmorph({directory / "in.geo"}).status == 0);
  check_image(read_linked(directory / "in.msh"));
}

TEST_CASE("periodic: either all surfaces of a family are converted or none") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, build_translated);
  const Linked before = read_linked(directory / "in.msh");
  const int master = before.links.front().master, slave = before.links.front().slave;
  const Result result =
      run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--surfaces", std::to_string(master)});
  CHECK(result.status == 3);
  CHECK(result.err.find("it is periodic with surface " + std::to_string(slave) + ", which stays as it is") !=
        std::string::npos);
  CHECK((read_file(directory / "in.msh") == read_file(directory / "out.msh")));
}

TEST_CASE("periodic: a mesh that is not the image of its master is left as it is, and so is the master") {
  // In a file that pairs the node and in one that does not: there Gmsh 4.8 has no pair, and later ones take the
  // nearest.
  for (const int pairs : {25, 24}) {
    CAPTURE(pairs);
    const TemporaryDirectory directory;
    write_file(directory / "in.msh", two_grids(0.1, pairs));
    const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
    CAPTURE(result.err);
    CHECK(result.status == 3);
    CHECK(result.err.find("surface 2: 32 triangles left as they were: it is periodic with surface 1, and its mesh is "
                          "not the image of that one's") != std::string::npos);
    CHECK(result.err.find("surface 1: 32 triangles left as they were: it is periodic with surface 2") !=
          std::string::npos);
    CHECK(last_x(directory / "out.msh") == 4.1);
  }
}

TEST_CASE("periodic: nodes of the boundary stay where the file has them, not where an exact image would be") {
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", two_grids(1e-4, 25));
  CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).status == 0);
  CHECK(last_x(directory / "out.msh") == 4.0001);
}
