// SPDX-License-Identifier: GPL-2.0-or-later
/// Nodes of curved surfaces of a geometry come to lie on it, with parameters; without a geometry, on the triangles.

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>

#include "gmsh/geometry/facets.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"
#include "qmorph/gmsh.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

/// Spheres with poles and seams, a torus with two, cones with an apex and without, B-splines, a piece of a sphere.
constexpr const char* kOcc = R"(SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, 1};
Torus(2) = {3, 0, 0, 1, 0.3};
Cone(3) = {6, 0, 0, 0, 0, 1.5, 1, 0.2};
Cone(4) = {9, 0, 0, 0, 0, 1.5, 1, 0};
Sphere(5) = {12, 0, 0, 1, -Pi/4, Pi/3, Pi*1.3};
Circle(101) = {0, 5, 0, 0.5}; Curve Loop(101) = {101};
Ellipse(102) = {0.1, 5, 1, 0.8, 0.5}; Curve Loop(102) = {102};
Circle(103) = {0, 5, 2, 0.4}; Curve Loop(103) = {103};
ThruSections(6) = {101:103};
Mesh.MeshSizeMax = 0.25;
)";

/// Gmsh's own kernel: an octant of a sphere and a surface between a spline and lines.
constexpr const char* kBuiltIn = R"(lc = 0.15;
Point(1) = {0, 0, 0, lc}; Point(2) = {1, 0, 0, lc}; Point(3) = {0, 1, 0, lc}; Point(4) = {0, 0, 1, lc};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Circle(3) = {4, 1, 2};
Curve Loop(1) = {1, 2, 3}; Surface(1) = {1};
Point(11) = {3, 0, 0, lc}; Point(12) = {4, 0, 0.3, lc}; Point(13) = {4, 1, 0, lc}; Point(14) = {3, 1, 0.5, lc};
Point(15) = {3.5, 0.1, 0.6, lc};
Spline(11) = {11, 15, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(2) = {11, 12, 13, 14}; Surface(2) = {2};
)";

struct Surface {
  int tag = 0;
  std::vector<std::size_t> tags;
  std::vector<double> xyz, uv;
  Eigen::Vector3d node(std::size_t i) const { return {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]}; }
};

std::vector<Surface> surfaces() {
  ::gmsh::vectorpair entities;
  ::gmsh::model::getEntities(entities, 2);
  std::vector<Surface> all;
  for (const auto& [dim, tag] : entities) {
    Surface& surface = all.emplace_back();
    surface.tag = tag;
    ::gmsh::model::mesh::getNodes(surface.tags, surface.xyz, surface.uv, 2, tag, false, true);
  }
  return all;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

void open_and_mesh(const std::string& script) {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", script);
  ::gmsh::open(directory / "in.geo");
  ::gmsh::model::mesh::generate(2);
}

constexpr double kExact = 1e-9;

}  // namespace

TEST_CASE("on geometry: nodes inside surfaces lie where their parameters say, within the range") {
  for (const char* script : {kOcc, kBuiltIn}) {
    const RunningGmsh gmsh;
    open_and_mesh(script);
    const ModelReport report = session::recombine();
    CHECK(report.count(SurfaceOutcome::left) == 0);
    CHECK(report.on_geometry.nodes > 100);
    CHECK(report.on_geometry.left == 0);
    for (const Surface& surface : surfaces()) {
      CAPTURE(surface.tag);
      if (surface.tags.empty()) continue;
      REQUIRE(surface.uv.size() == 2 * surface.tags.size());
      std::vector<double> there, low, high;
      ::gmsh::model::getValue(2, surface.tag, surface.uv, there);
      CHECK(largest_difference(there, surface.xyz) < kExact);
      ::gmsh::model::getParametrizationBounds(2, surface.tag, low, high);
      for (std::size_t i = 0; i < surface.uv.size(); ++i) {
        CHECK(surface.uv[i] >= low[i % 2] - kExact);
        CHECK(surface.uv[i] <= high[i % 2] + kExact);
      }
      // The place is the nearest one, not just any.
      std::vector<double> nearest, ignored;
      ::gmsh::model::getClosestPoint(2, surface.tag, surface.xyz, nearest, ignored);
      CHECK(largest_difference(nearest, surface.xyz) < 1e-7);
    }
  }
}

TEST_CASE("on geometry: facets of a coarse coil are no creases") {
  const RunningGmsh gmsh;
  open_and_mesh(R"(SetFactory("OpenCASCADE");
For i In {0:12}
  Point(i+1) = {30*Cos(i*Pi/6), 30*Sin(i*Pi/6), 3*i};
EndFor
Spline(1) = {1:13}; Wire(1) = {1};
Disk(1) = {30, 0, 0, 6}; Rotate {{1, 0, 0}, {30, 0, 0}, Pi/2} { Surface{1}; }
Extrude { Surface{1}; } Using Wire {1}
Delete { Surface{1}; }
Mesh.MeshSizeMax = 9;
)");
  const ModelReport report = session::recombine();
  CHECK(report.count(SurfaceOutcome::left) == 0);
  CHECK(report.total.scaled_jacobian_min > 0.5);
  CHECK(report.on_geometry.nodes > 50);
  CHECK(report.on_geometry.left == 0);
}

TEST_CASE("on geometry: a geometry with a kink has a crease there") {
  constexpr double kAngle = 0.3;
  for (const bool is_kinked : {true, false}) {
    CAPTURE(is_kinked);
    const adapter::Session session;
    ::gmsh::model::add("roof");
    std::vector<int> points;
    for (int i = 0; i < 5; ++i) points.push_back(::gmsh::model::occ::addPoint(i, 0, i < 3 ? 2 * i : 2 * (4 - i)));
    const int curve = is_kinked ? ::gmsh::model::occ::addBSpline(points, -1, 1)  // of straight pieces
                                : ::gmsh::model::occ::addSpline(points);
    ::gmsh::vectorpair made;
    ::gmsh::model::occ::extrude({{1, curve}}, 0, 3, 0, made);
    ::gmsh::model::occ::synchronize();
    ::gmsh::option::setNumber("Mesh.MeshSizeMax", 1.2);
    ::gmsh::model::mesh::generate(2);
    const adapter::ModelMesh mesh = adapter::read_model_mesh();
    const adapter::NodeUse use = adapter::find_node_use(mesh);
    const adapter::FixedEdges edges(mesh, use);
    std::vector<Index> local(mesh.tags.size(), kNone);
    for (std::uint32_t e = 0; e < mesh.entities.size(); ++e)
      if (mesh.entities[e].dim == 2)
        CHECK(adapter::has_only_facets(mesh, adapter::read_surface(mesh, use, edges, e, local), kAngle) != is_kinked);
  }
}

TEST_CASE("on geometry: without a geometry, the mesh is all there is") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [] { open_and_mesh(kBuiltIn); });
  const RunningGmsh gmsh;
  ::gmsh::open(directory / "in.msh");
  const ModelReport report = session::recombine();
  CHECK(report.count(SurfaceOutcome::converted) == 2);
  CHECK(report.on_geometry.nodes == 0);
  CHECK(report.on_geometry.left == 0);
  CHECK(report.fidelity.node.max < 1e-6);
}

TEST_CASE("on geometry: a mesh that was merged onto its geometry has no parameters, and comes to lie on it") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kOcc);
  make_msh(directory / "in.msh", 4.1, false, [&] {
    ::gmsh::open(directory / "in.geo");
    ::gmsh::model::mesh::generate(2);
  });
  const RunningGmsh gmsh;
  ::gmsh::open(directory / "in.geo");
  ::gmsh::merge(directory / "in.msh");
  const ModelReport report = session::recombine();
  CHECK(report.count(SurfaceOutcome::left) == 0);
  CHECK(report.on_geometry.nodes > 100);
  CHECK(report.on_geometry.left == 0);
  for (const Surface& surface : surfaces()) {
    std::vector<double> nearest, ignored;
    if (!surface.tags.empty()) ::gmsh::model::getClosestPoint(2, surface.tag, surface.xyz, nearest, ignored);
    CHECK(largest_difference(nearest, surface.xyz) < 1e-7);
  }
}

TEST_CASE("on geometry: a mesh that has been moved away from it stays where it is") {
  const RunningGmsh gmsh;
  open_and_mesh(kBuiltIn);
  std::vector<std::size_t> tags;
  std::vector<double> xyz, ignored;
  ::gmsh::model::mesh::getNodes(tags, xyz, ignored, -1, -1, false, false);
  for (std::size_t i = 0; i < tags.size(); ++i)
    ::gmsh::model::mesh::setNode(tags[i], {1.2 * xyz[3 * i], 1.2 * xyz[3 * i + 1], 1.2 * xyz[3 * i + 2]}, {});
  const ModelReport report = session::recombine();
  CHECK(report.count(SurfaceOutcome::converted) == 2);
  CHECK(report.on_geometry.nodes == 0);
  CHECK(report.on_geometry.left > 50);
  CHECK(report.fidelity.node.max < 1e-6);
}

TEST_CASE("on geometry: the summary and the statistics report it") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kBuiltIn);
  const Result result = run_qmorph({directory / "in.geo", "--stats", directory / "stats.json"});
  CHECK(result.status == 0);
  CHECK(result.err.find("; nodes on the geometry;") != std::string::npos);
  const auto json = nlohmann::json::parse(read_file(directory / "stats.json"));
  CHECK(json["on_geometry"]["nodes"] > 50);
  CHECK(json["on_geometry"]["left"] == 0);
  CHECK(json["surfaces"][0]["on_geometry"]["nodes"] > 20);
}

TEST_CASE("on geometry: surfaces that are images of one another stay so, each with parameters of its own") {
  const TemporaryDirectory directory;
  const RunningGmsh gmsh;
  namespace occ = ::gmsh::model::occ;
  // Two sheets of cylinders, one moved up.
  for (const double z : {0.0, 3.0}) {
    const int line = occ::addLine(occ::addPoint(1, 0, z), occ::addPoint(1, 0, z + 1));
    ::gmsh::vectorpair out;
    occ::revolve({{1, line}}, 0, 0, z, 0, 0, 1, 2, out);
  }
  occ::synchronize();
  ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.2);
  ::gmsh::model::mesh::setPeriodic(2, {2}, {1}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 3, 0, 0, 0, 1});
  ::gmsh::model::mesh::generate(2);
  const ModelReport report = session::recombine();
  REQUIRE(report.count(SurfaceOutcome::converted) == 2);
  CHECK(report.surfaces[1].image_of == 1);
  CHECK(report.on_geometry.left == 0);
  for (const Surface& surface : surfaces()) {
    std::vector<double> there;
    REQUIRE(surface.uv.size() == 2 * surface.tags.size());
    ::gmsh::model::getValue(2, surface.tag, surface.uv, there);
    CHECK(largest_difference(there, surface.xyz) < kExact);
    for (std::size_t i = 0; i < surface.tags.size(); ++i)
      CHECK(std::abs(std::hypot(surface.xyz[3 * i], surface.xyz[3 * i + 1]) - 1) < kExact);
  }
}
