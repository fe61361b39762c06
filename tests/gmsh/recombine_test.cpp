// SPDX-License-Identifier: GPL-2.0-or-later
/// The call inside a program that runs the Gmsh API itself.

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <stdexcept>
#include <string>

#include "gmsh/model/model_mesh.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"
#include "qmorph/gmsh.hpp"
#include "support/watcher.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

double option(const char* name) {
  double value = 0;
  ::gmsh::option::getNumber(name, value);
  return value;
}

std::size_t count_elements(int type) {
  std::vector<std::size_t> tags, nodes;
  ::gmsh::model::mesh::getElementsByType(type, tags, nodes);
  return tags.size();
}

/// All nodes and elements, to compare.
struct WholeMesh {
  std::vector<std::size_t> node_tags;
  std::vector<double> xyz, uv;
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> element_tags, nodes;
  WholeMesh() {
    ::gmsh::model::mesh::getNodes(node_tags, xyz, uv);
    ::gmsh::model::mesh::getElements(types, element_tags, nodes);
  }
  bool operator==(const WholeMesh&) const = default;
};

}  // namespace

TEST_CASE("recombine: stands in for gmsh::model::mesh::recombine") {
  const RunningGmsh gmsh;
  build_two_squares();
  const double abort_on_error = option("General.AbortOnError"), verbosity = option("General.Verbosity");
  const std::size_t lines = count_elements(adapter::kLine2);
  const ModelReport report = session::recombine();
  CHECK(report.count(SurfaceOutcome::converted) == 2);
  CHECK(report.surfaces[0].name == "left");
  CHECK(count_elements(adapter::kQuad4) == report.total.quads);
  CHECK(count_elements(adapter::kTriangle3) == report.total.triangles);
  CHECK(count_elements(adapter::kLine2) == lines);
  CHECK(report.total.scaled_jacobian_min > 0);
  CHECK(option("General.AbortOnError") == abort_on_error);
  CHECK(option("General.Verbosity") == verbosity);

  // A second run in the same process sees nothing of the first.
  const ModelReport again = session::recombine({}, {2});
  CHECK(again.surfaces.size() == 1);
  CHECK(again.count(SurfaceOutcome::already_quads) == 1);
}

TEST_CASE("recombine: qmorph::gmsh::recombine(options) is the same for all surfaces") {
  const RunningGmsh gmsh;
  build_two_squares();
  const ModelReport report = qmorph::gmsh::recombine(Options());
  CHECK(report.count(SurfaceOutcome::converted) == 2);
  CHECK(count_elements(adapter::kTriangle3) == 0);
}

TEST_CASE("recombine: two models in one process, one after the other") {
  const RunningGmsh gmsh;
  build_two_squares();
  const ModelReport first = session::recombine();
  ::gmsh::clear();
  build_two_squares();
  const ModelReport second = session::recombine();
  CHECK(first.total.quads == second.total.quads);
  CHECK(first.total.scaled_jacobian_mean == second.total.scaled_jacobian_mean);
}

TEST_CASE("recombine: naming a surface that does not exist leaves the model unchanged") {
  const RunningGmsh gmsh;
  build_two_squares();
  const std::size_t triangles = count_elements(adapter::kTriangle3);
  CHECK_THROWS_WITH_AS(session::recombine({}, {1, 99}), "the model has no surface 99", UsageError);
  CHECK(count_elements(adapter::kTriangle3) == triangles);
  CHECK(count_elements(adapter::kQuad4) == 0);
}

TEST_CASE("recombine: nodes of CAD surfaces keep parameters, and a volume can be meshed on the quads") {
  const RunningGmsh gmsh;
  ::gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
  ::gmsh::model::occ::synchronize();
  ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.25);
  ::gmsh::model::mesh::generate(2);
  CHECK(session::recombine().count(SurfaceOutcome::converted) == 6);
  const adapter::ModelMesh mesh = adapter::read_model_mesh();
  for (const auto& entity : mesh.entities) {
    if (entity.dim != 2) continue;
    REQUIRE(entity.uv.size() == 2 * entity.node_tags.size());
    std::vector<double> xyz;
    ::gmsh::model::getValue(2, entity.tag, entity.uv, xyz);
    for (std::size_t i = 0; i < xyz.size(); ++i) CHECK(xyz[i] == doctest::Approx(entity.xyz[i]).epsilon(1e-9));
  }
  const std::size_t quads = count_elements(adapter::kQuad4);
  ::gmsh::model::mesh::generate(3);
  CHECK(count_elements(adapter::kQuad4) == quads);
  constexpr int kPyramid = 7;
  CHECK(count_elements(kPyramid) == quads);
}

TEST_CASE("recombine: an empty model has an empty report") {
  const RunningGmsh gmsh;
  CHECK(session::recombine().surfaces.empty());
}

TEST_CASE("recombine: after cancelling or throwing the mesh is as it was, and work can go on") {
  const RunningGmsh gmsh;
  build_two_squares();
  const WholeMesh before;
  for (int n : {1, 2, 5}) {
    CAPTURE(n);
    int calls = 0;
    Options options;
    options.progress = [&](std::string_view, double) { return ++calls < n ? Progress::go_on : Progress::cancel; };
    CHECK_THROWS_AS(session::recombine(options), Cancelled);
    CHECK(WholeMesh() == before);
    calls = 0;
    options.progress = [&](std::string_view, double) {
      return ++calls < n ? Progress::go_on : throw std::range_error("mine");
    };
    CHECK_THROWS_WITH_AS(session::recombine(options), "mine", std::range_error);
    CHECK_THROWS_WITH_AS(session::improve_quads(options), "mine", std::range_error);
    CHECK(WholeMesh() == before);
  }
  CHECK(session::recombine().count(SurfaceOutcome::converted) == 2);
}

TEST_CASE("recombine: observers are told of surfaces by their tags") {
  const RunningGmsh gmsh;
  build_two_squares();
  Watcher watcher;
  Options options;
  options.observer = &watcher;
  const ModelReport report = session::recombine(options);
  REQUIRE(report.surfaces.size() == 2);
  REQUIRE(watcher.stages.size() == 2 * kStages);
  for (std::size_t i = 0; i < 2; ++i) {
    const Watcher::StageNote& last = watcher.stages[(i + 1) * kStages - 1];
    CHECK(int(last.surface) == report.surfaces[i].tag);
    CHECK(last.mesh.quads.size() == report.surfaces[i].quads_out);
    CHECK(int(watcher.fronts[i].surface) == report.surfaces[i].tag);
    CHECK(watcher.fronts[i].player().surface == watcher.fronts[i].surface);
  }
}

TEST_CASE("recombine: errors carry tags and places") {
  const RunningGmsh gmsh;
  build_two_squares();
  try {
    session::recombine({}, {99});
    FAIL("nothing was said");
  } catch (const UsageError& error) {
    CHECK(error.kind() == ErrorKind::no_such_entity);
    REQUIRE(error.subject());
    CHECK(error.subject()->kind == ErrorSubject::Kind::surface);
    CHECK(error.subject()->number == 99);
  }
  std::vector<std::size_t> tags;
  std::vector<double> xyz, uv;
  ::gmsh::model::mesh::getNodes(tags, xyz, uv, 2, 1);
  REQUIRE_FALSE(tags.empty());
  ::gmsh::model::mesh::setNode(tags[0], {xyz[0] + 5, xyz[1], 0}, {});  // far outside: triangles lie over one another
  const ModelReport report = session::recombine({}, {1});
  REQUIRE(report.surfaces[0].outcome == SurfaceOutcome::left);
  REQUIRE(report.surfaces[0].error);
  const ErrorDetails& error = *report.surfaces[0].error;
  CHECK(error.kind == ErrorKind::overlap);
  REQUIRE(error.place);
  REQUIRE(error.subject);
  const adapter::ModelMesh mesh = adapter::read_model_mesh();
  CHECK(mesh.points[mesh.rows.find(error.subject->number)] == *error.place);
}
