// SPDX-License-Identifier: GPL-2.0-or-later
/// Each kind of model through each version and encoding: what was not converted is identical, entity by entity.

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

namespace occ = ::gmsh::model::occ;
namespace mesh = ::gmsh::model::mesh;

/// Squares of size 1 side by side, sharing curves, as surfaces 1 to n.
void add_squares(int n) {
  ::gmsh::vectorpair squares, out;
  std::vector<::gmsh::vectorpair> map;
  for (int i = 0; i < n; ++i) squares.emplace_back(2, occ::addRectangle(i, 0, 0, 1, 1));
  if (n > 1) occ::fragment({squares.front()}, {squares.begin() + 1, squares.end()}, out, map);
  occ::synchronize();
  ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.2);
}

void group(int dim, const std::vector<int>& entities, int tag, const std::string& name) {
  ::gmsh::model::addPhysicalGroup(dim, entities, tag);
  ::gmsh::model::setPhysicalName(dim, tag, name);
}

void build_transfinite() {
  add_squares(3);
  ::gmsh::vectorpair curves;
  ::gmsh::model::getBoundary({{2, 2}}, curves, false, false, false);
  for (const auto& [dim, tag] : curves) mesh::setTransfiniteCurve(tag, 7);
  mesh::setTransfiniteSurface(2);
  mesh::setRecombine(2, 2);
  mesh::generate(2);
}

void build_layers() {
  const int field = mesh::field::add("BoundaryLayer");
  add_squares(1);
  ::gmsh::vectorpair curves;
  ::gmsh::model::getBoundary({{2, 1}}, curves, false, false, false);
  std::vector<double> tags;
  for (const auto& [dim, tag] : curves) tags.push_back(tag);
  mesh::field::setNumbers(field, "EdgesList", tags);
  mesh::field::setNumber(field, "hwall_n", 0.03);
  mesh::field::setNumber(field, "thickness", 0.1);
  mesh::field::setNumber(field, "Quads", 1);
  mesh::field::setAsBoundaryLayer(field);
  mesh::generate(2);
}

void build_names() {
  add_squares(2);
  group(2, {1}, 1, "äußere Platte");
  group(2, {2}, 2, "it's 5 % / steel\\x");
  group(1, {1}, 7, "вход");
  group(0, {1}, 7, "a  b");
  group(1, {2, 3, 4, 5, 6, 7}, 8, "rest");
  mesh::generate(2);
}

void build_with_volume() {
  add_squares(1);
  occ::addBox(3, 0, 0, 1, 1, 1);
  occ::synchronize();
  ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.4);
  mesh::generate(3);
}

/// A curve, a point and a surface far from everything else, and a surface without elements.
void build_orphans() {
  add_squares(1);
  occ::addLine(occ::addPoint(5, 0, 0, 0.3), occ::addPoint(6, 0, 0, 0.3));
  occ::addPoint(7, 0, 0);
  occ::synchronize();
  mesh::generate(2);
  ::gmsh::model::addDiscreteEntity(2, 99);
  ::gmsh::model::addDiscreteEntity(1, 98);
}

void build_gaps() {
  ::gmsh::model::addDiscreteEntity(2, 5);
  const Grid grid;
  std::vector<std::size_t> nodes, elements, corners;
  std::vector<double> xyz;
  for (const auto& p : grid.nodes()) {
    nodes.push_back(1000 + 37 * nodes.size());
    xyz.insert(xyz.end(), p.begin(), p.end());
  }
  for (const auto& triangle : grid.triangles()) {
    elements.push_back(5 + 11 * elements.size());
    for (int node : triangle) corners.push_back(nodes[static_cast<std::size_t>(node - 1)]);
  }
  mesh::addNodes(2, 5, nodes, xyz);
  mesh::addElements(2, 5, {2}, {elements}, {corners});
}

void build_crack() {
  build_two_squares();
  ::gmsh::model::removePhysicalGroups({});
}

void build_periodic() {
  add_squares(2);
  ::gmsh::vectorpair left, right;
  ::gmsh::model::getEntitiesInBoundingBox(-0.1, -0.1, -0.1, 0.1, 1.1, 0.1, left, 1);
  ::gmsh::model::getEntitiesInBoundingBox(1.9, -0.1, -0.1, 2.1, 1.1, 0.1, right, 1);
  mesh::setPeriodic(1, {right[0].second}, {left[0].second}, {1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  mesh::generate(2);
}

void build_second_order() {
  build_transfinite();
  mesh::setOrder(2);
}

struct Model {
  const char* name;
  std::function<void()> build;
  std::set<int> converted;
  int status;
};

const std::vector<Model> kModels = {
    {"embedded curve and point", build_crack, {1, 2}, 0},
    {"transfinite quads in the middle", build_transfinite, {1, 3}, 0},
    {"boundary layer of quads", build_layers, {1}, 0},
    {"names", build_names, {1, 2}, 0},
    {"tetrahedra elsewhere", build_with_volume, {1}, 3},
    {"orphans", build_orphans, {1}, 0},
    {"gaps in the numbers", build_gaps, {5}, 0},
    {"periodic curves", build_periodic, {1, 2}, 0},
};

}  // namespace

TEST_CASE("matrix: what is not converted is identical, through each version and encoding") {
  for (const Model& model : kModels)
    for (const double version : {2.2, 4.1})
      for (const bool binary : {false, true}) {
        CAPTURE(std::string(model.name));
        CAPTURE(version);
        CAPTURE(binary);
        const TemporaryDirectory directory;
        make_msh(directory / "in.msh", version, binary, model.build);
        const Snapshot before = read_snapshot(directory / "in.msh");
        const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
        CAPTURE(result.err);
        CHECK(result.status == model.status);
        const Snapshot after = read_snapshot(directory / "out.msh");
        CHECK(difference(before, after, model.converted) == "");
        for (int surface : model.converted) {
          CHECK(element_counts(after, surface).second > 0);
          CHECK(element_counts(after, surface).first <= 1);
        }
      }
}

TEST_CASE("matrix: second order") {
  for (const double version : {2.2, 4.1})
    for (const bool binary : {false, true}) {
      const TemporaryDirectory directory;
      make_msh(directory / "in.msh", version, binary, build_second_order);
      CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).status == 0);
      const Snapshot before = read_snapshot(directory / "in.msh"), after = read_snapshot(directory / "out.msh");
      CHECK(difference(before, after, {1, 3}) == "");
    }
}

TEST_CASE("matrix: from each version into each other") {
  const TemporaryDirectory directory;
  for (const double version : {2.2, 4.1}) {
    make_msh(directory / "in.msh", version, false, build_crack);
    CAPTURE(version);
    check_formats(directory / "in.msh", {"msh1", "msh22", "msh3", "msh40", "msh41"}, {1, 2});
  }
}
