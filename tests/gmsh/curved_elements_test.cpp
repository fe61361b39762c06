// SPDX-License-Identifier: GPL-2.0-or-later
/// Middle nodes of elements of second and higher order on curved surfaces.

#include "gmsh/model/curved_elements.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "gmsh/model/high_order.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"
#include "qmorph/gmsh.hpp"
#include "report/summary.hpp"

using namespace qmorph;
using namespace qmorph::test;
using Eigen::Vector3d;

namespace {

/// Shapes whose distance from a point is known.
struct Solid {
  const char* script;
  std::function<double(const Vector3d&)> distance;
};

const Solid kBall = {"Sphere(1) = {0, 0, 0, 1};", [](const Vector3d& p) { return std::abs(p.norm() - 1); }};
const Solid kRing = {"Torus(1) = {0, 0, 0, 1, 0.4};",
                     [](const Vector3d& p) { return std::abs(std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()) - 0.4); }};
/// Without its flat ends.
const Solid kTube = {
    "Cylinder(1) = {0, 0, 0, 0, 0, 2, 0.7}; Recursive Delete { Volume{1}; }\n"
    "Circle(11) = {0, 0, 0, 0.7}; Extrude {0, 0, 2} { Curve{11}; }",
    [](const Vector3d& p) { return std::abs(std::hypot(p.x(), p.y()) - 0.7); }};
constexpr double kSize = 0.25;

std::string script_of(const Solid& solid) {
  return std::string("SetFactory(\"OpenCASCADE\");\n") + solid.script +
         "\nMesh.MeshSizeMax = " + std::to_string(kSize) + ";\nMesh.MeshSizeMin = Mesh.MeshSizeMax;\n";
}

void open_and_mesh(const Solid& solid, int order) {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", script_of(solid));
  ::gmsh::open(directory / "in.geo");
  ::gmsh::model::mesh::generate(2);
  ::gmsh::model::mesh::setOrder(order);
}

/// Of all nodes of surfaces, in edges.
double farthest(const adapter::ModelMesh& mesh, const Solid& solid) {
  double most = 0;
  for (const adapter::EntityMesh& entity : mesh.entities)
    for (const adapter::ElementBlock& block : entity.blocks)
      for (std::size_t i = 0; entity.dim == 2 && i < block.nodes.size(); ++i)
        most = std::max(most, solid.distance(mesh.points[mesh.rows.find(block.nodes[i])]) / kSize);
  return most;
}

/// Quads of this order, and none of them folded.
void check_elements(const adapter::ModelMesh& mesh, int order) {
  for (const adapter::EntityMesh& entity : mesh.entities) {
    if (entity.dim != 2 || entity.blocks.empty()) continue;
    CHECK(adapter::order_of(entity) == order);
    REQUIRE(entity.polygons(4));
    CHECK(entity.polygons(4)->tags.size() > 20);
    CHECK(adapter::find_bent(adapter::read_curved_elements(mesh, entity)) == "");
  }
}

/// A unit square beside another, of order 2. \param bow how far the side between them is bent into the second
adapter::CurvedElements two_squares(double bow) {
  adapter::CurvedElements elements({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}});
  for (const std::size_t corners : {3, 4})
    elements.set_type(adapter::element_type(adapter::type_number(corners, 2, false)));
  const Index left = elements.add({0, 1, 2, 3}), right = elements.add({1, 4, 5, 2});
  elements.side(elements.element(left).sides[1]).nodes[0].place.x() += bow;
  elements.fill(left), elements.fill(right);
  return elements;
}

}  // namespace

TEST_CASE("curved elements: on a geometry, all nodes come to lie on it") {
  for (const Solid& solid : {kBall, kRing, kTube})
    for (const int order : {2, 3}) {
      CAPTURE(solid.script);
      CAPTURE(order);
      const RunningGmsh gmsh;
      open_and_mesh(solid, order);
      const ModelReport report = session::recombine();
      CHECK(report.count(SurfaceOutcome::left) == 0);
      CHECK(report.on_geometry.left == 0);
      CHECK(report.on_geometry.moved_sides == 0);
      const adapter::ModelMesh mesh = adapter::read_model_mesh();
      check_elements(mesh, order);
      CHECK(farthest(mesh, solid) < 1e-9);
      for (const adapter::EntityMesh& entity : mesh.entities) {
        if (entity.dim != 2 || entity.blocks.empty()) continue;
        REQUIRE(entity.uv.size() == 2 * entity.node_tags.size());
        std::vector<double> there;
        ::gmsh::model::getValue(2, entity.tag, entity.uv, there);
        for (std::size_t i = 0; i < there.size(); ++i) CHECK(there[i] == doctest::Approx(entity.xyz[i]).epsilon(1e-9));
      }
    }
}

TEST_CASE("curved elements: without a geometry, all nodes come to lie on the input's curved elements") {
  for (const Solid& solid : {kBall, kRing, kTube})
    for (const int order : {2, 3}) {
      CAPTURE(solid.script);
      CAPTURE(order);
      const TemporaryDirectory directory;
      make_msh(directory / "in.msh", 4.1, true, [&] { open_and_mesh(solid, order); });
      const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
      CAPTURE(result.err);
      CHECK(result.status == 0);
      CHECK(result.err.find("; nodes on the geometry;") != std::string::npos);
      const Snapshot after = read_snapshot(directory / "out.msh");
      const RunningGmsh gmsh;  // which knows what types are
      check_elements(after.mesh, order);
      CHECK(farthest(after.mesh, solid) < 5e-3);  // flat triangles are up to 0.08 edges off
    }
}

TEST_CASE("curved elements: raised by the command, all nodes lie on the geometry") {
  for (const Solid& solid : {kBall, kRing, kTube}) {
    CAPTURE(solid.script);
    const TemporaryDirectory directory;
    write_file(directory / "in.geo", script_of(solid));
    const Result result = run_qmorph({"-2", directory / "in.geo", "-order", "2", "-o", directory / "out.msh"});
    CAPTURE(result.err);
    CHECK(result.status == 0);
    const Snapshot after = read_snapshot(directory / "out.msh");
    const RunningGmsh gmsh;
    check_elements(after.mesh, 2);
    CHECK(farthest(after.mesh, solid) < 1e-9);
  }
}

TEST_CASE("curved elements: a side that folds an element is made straight, and given ones are not") {
  const RunningGmsh gmsh;
  for (const double bow : {0.0, 0.5, -0.5}) {
    adapter::CurvedElements elements = two_squares(bow);
    CHECK(elements.find_folded() == kNone);
    CHECK(elements.unfold() == 0);
  }
  for (const double bow : {1.2, -1.2, 1.5}) {
    CAPTURE(bow);
    adapter::CurvedElements elements = two_squares(bow);
    const Index middle = elements.element(0).sides[1];
    CHECK(elements.find_folded() == (bow > 0 ? 1 : 0));
    for (Index side = 0; side < elements.sides(); ++side) elements.side(side).is_given = true;
    CHECK(elements.unfold() == 0);
    CHECK(elements.side(middle).nodes[0].place.x() == 1 + bow);
    CHECK(elements.find_folded() != kNone);
    elements.side(middle).is_given = false;
    CHECK(elements.unfold() == 1);
    CHECK(elements.side(middle).nodes[0].place == Vector3d(1, 0.5, 0));
    CHECK(elements.find_folded() == kNone);
  }
}

TEST_CASE("curved elements: where a given side folds an element, the side opposite follows it") {
  const RunningGmsh gmsh;
  for (const int order : {2, 3})
    for (const bool turned : {false, true}) {  // which end of the side between the two comes first
      CAPTURE(order);
      CAPTURE(turned);
      // A flat element under an arch that bulges into it, and a high one under that.
      adapter::CurvedElements elements({{0, 1, 0}, {3, 1, 0}, {3, 1.4, 0}, {0, 1.4, 0}, {0, -1, 0}, {3, -1, 0}});
      for (const std::size_t corners : {3, 4})
        elements.set_type(adapter::element_type(adapter::type_number(corners, order, false)));
      if (turned) elements.add_side(1, 0);
      const Index flat = elements.add({0, 1, 2, 3}), high = elements.add({4, 5, 1, 0});
      adapter::CurvedSide& arch = elements.side(elements.element(flat).sides[2]);
      arch.is_given = true;
      for (adapter::MiddleNode& node : arch.nodes) node.place.y() -= node.place.x() < 1.2 ? 0.5 : 0.45;
      elements.fill(flat);
      CHECK(elements.find_folded() == flat);
      CHECK(elements.unfold() == 1);
      CHECK(elements.find_folded() == kNone);
      CHECK(elements.side(elements.element(flat).sides[0]).has_moved);
      CHECK(!elements.is_folded(high));
    }
}

TEST_CASE("curved elements: where a given side turns past the one beside it, that turns with it") {
  const RunningGmsh gmsh;
  for (const int order : {2, 3})
    for (const bool turned : {false, true}) {
      CAPTURE(order);
      CAPTURE(turned);
      // The given side leaves the corner (0, 0) at 135 degrees, where the side beside it leads at 132.
      adapter::CurvedElements elements(
          {{0, 0, 0}, {0, 1, 0}, {-1, 1.6, 0}, {-1, 1.1, 0}, {-1.2, -0.6, 0}, {0.2, -0.8, 0}});
      for (const std::size_t corners : {3, 4})
        elements.set_type(adapter::element_type(adapter::type_number(corners, order, false)));
      if (turned) elements.add_side(3, 0), elements.add_side(1, 0);
      const Index over = elements.add({0, 1, 2, 3}), under = elements.add({0, 3, 4, 5});
      adapter::CurvedSide& given = elements.side(elements.element(over).sides[0]);
      given.is_given = true;
      for (adapter::MiddleNode& node : given.nodes) node.place.x() -= node.place.y() * (1 - node.place.y());
      elements.fill(over);
      CHECK(elements.find_folded() == over);
      CHECK(elements.unfold() > 0);
      CHECK(elements.find_folded() == kNone);
      CHECK(elements.side(elements.element(over).sides[3]).has_moved);
      CHECK(!elements.is_folded(under));
    }
}

TEST_CASE("curved elements: where few edges go round a circle, no quad has two of them") {
  const char* const kDisks[] = {
      "Disk(1) = {0, 0, 0, 0.2}; MeshSize{:} = 0.2;",                    // six edges
      "Disk(1) = {0, 0, 0, 0.2}; Curve{1}; Transfinite Curve{1} = 8;",   // seven
      "Cone(1) = {0, 0, 0, 0, 0, 2, 1, 0.2}; MeshSize{:} = 0.2;",        // a small end
      "Cylinder(1) = {0, 0, 0, 0, 0, 1, 0.5, Pi}; MeshSize{:} = 0.45;",  // half circles
  };
  for (const char* disk : kDisks)
    for (const char* order : {"2", "3"})
      for (const bool from_mesh : {false, true}) {
        CAPTURE(disk);
        CAPTURE(order);
        CAPTURE(from_mesh);
        const TemporaryDirectory directory;
        write_file(directory / "in.geo", std::string("SetFactory(\"OpenCASCADE\");\n") + disk);
        std::string input = directory / "in.geo";
        if (from_mesh) {
          make_msh(input = directory / "in.msh", 4.1, true, [&] {
            ::gmsh::open(directory / "in.geo");
            ::gmsh::model::mesh::generate(2);
            ::gmsh::model::mesh::setOrder(order[0] - '0');
          });
        }
        const Result result = run_qmorph({"-2", input, "-order", order, "-o", directory / "out.msh"});
        CAPTURE(result.err);
        CHECK(result.status == 0);
        const Snapshot after = read_snapshot(directory / "out.msh");
        const RunningGmsh gmsh;
        for (const adapter::EntityMesh& entity : after.mesh.entities)
          if (entity.dim == 2 && !entity.blocks.empty())
            CHECK(adapter::find_bent(adapter::read_curved_elements(after.mesh, entity)) == "");
      }
}

/// A thin crescent between two circles.
const char* const kCrescent =
    "SetFactory(\"OpenCASCADE\"); Disk(1) = {0, 0, 0, 1}; Disk(2) = {0.01, 0, 0, 1};\n"
    "BooleanDifference{ Surface{1}; Delete; }{ Surface{2}; Delete; }\n"
    "MeshSize{:} = 0.3; Mesh.MeshSizeMin = 0.3; Mesh.MeshSizeMax = 0.3;";

TEST_CASE("curved elements: when an order is raised, sides on curves are made straight where nothing else helps") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kCrescent);
  const Result result = run_qmorph({"-2", directory / "in.geo", "-order", "2", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  CHECK(result.err.find(" moved to unfold elements") != std::string::npos);
  const Snapshot after = read_snapshot(directory / "out.msh");
  const RunningGmsh gmsh;
  for (const adapter::EntityMesh& entity : after.mesh.entities)
    if (entity.dim == 2 && !entity.blocks.empty())
      CHECK(adapter::find_bent(adapter::read_curved_elements(after.mesh, entity)) == "");
}

TEST_CASE("curved elements: an edge inside a surface that bends too far is made straight, and not taken over") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, true, [&] {
    write_file(directory / "in.geo", "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 3, 3}; MeshSize{:} = 0.5;");
    ::gmsh::open(directory / "in.geo");
    ::gmsh::model::mesh::generate(2);
    ::gmsh::model::mesh::setOrder(2);
    // All middle nodes inside go to one end of their edges, nearly.
    std::vector<std::size_t> tags, nodes;
    ::gmsh::model::mesh::getElementsByType(9, tags, nodes);
    std::vector<double> at, parameters;
    std::vector<std::size_t> inner;
    ::gmsh::model::mesh::getNodes(inner, at, parameters, 2, 1);
    const auto place = [](std::size_t node) { return Vector3d(adapter::placed_node(node).xyz.data()); };
    for (std::size_t e = 0; e + 5 < nodes.size(); e += 6)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t a = nodes[e + k], b = nodes[e + (k + 1) % 3], middle = nodes[e + 3 + k];
        if (std::count(inner.begin(), inner.end(), middle) == 0) continue;
        const Vector3d p = 0.9 * place(std::min(a, b)) + 0.1 * place(std::max(a, b));
        ::gmsh::model::mesh::setNode(middle, {p.x(), p.y(), p.z()}, {});
      }
  });
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  const Snapshot after = read_snapshot(directory / "out.msh");
  const RunningGmsh gmsh;
  check_elements(after.mesh, 2);
}

TEST_CASE("curved elements: the summary tells what is straight, and what is not on the geometry") {
  ModelReport model;
  CHECK(report::total_line(model, "out.msh", 0).find("straight") == std::string::npos);
  model.on_geometry = {.nodes = 90, .left = 3, .moved_sides = 1};
  CHECK(report::total_line(model, "out.msh", 0)
            .find("; nodes on the geometry but 3 of 93; 1 side moved to unfold elements;") != std::string::npos);
  model.on_geometry = {.moved_sides = 2};
  CHECK(report::total_line(model, "out.msh", 0).find("; 2 sides moved to unfold elements;") != std::string::npos);
}
