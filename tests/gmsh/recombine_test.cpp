/// The call inside a program that runs the Gmsh API itself.

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <string>

#include "gmsh/model/model_mesh.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"
#include "qmorph/gmsh.hpp"

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

}  // namespace

TEST_CASE("recombine: stands in for gmsh::model::mesh::recombine") {
  const RunningGmsh gmsh;
  build_two_squares();
  const double abort_on_error = option("General.AbortOnError"), verbosity = option("General.Verbosity");
  const std::size_t lines = count_elements(adapter::kLine2);
  const ModelReport report = recombine();
  CHECK(report.count(SurfaceOutcome::converted) == 2);
  CHECK(report.surfaces[0].name == "left");
  CHECK(count_elements(adapter::kQuad4) == report.total.quads);
  CHECK(count_elements(adapter::kTriangle3) == report.total.triangles);
  CHECK(count_elements(adapter::kLine2) == lines);
  CHECK(report.total.scaled_jacobian_min > 0);
  CHECK(option("General.AbortOnError") == abort_on_error);
  CHECK(option("General.Verbosity") == verbosity);

  // A second run in the same process sees nothing of the first.
  const ModelReport again = recombine({2});
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
  const ModelReport first = recombine();
  ::gmsh::clear();
  build_two_squares();
  const ModelReport second = recombine();
  CHECK(first.total.quads == second.total.quads);
  CHECK(first.total.scaled_jacobian_mean == second.total.scaled_jacobian_mean);
}

TEST_CASE("recombine: a surface that is not there leaves the model alone") {
  const RunningGmsh gmsh;
  build_two_squares();
  const std::size_t triangles = count_elements(adapter::kTriangle3);
  CHECK_THROWS_WITH_AS(recombine({1, 99}), "the model has no surface 99", UsageError);
  CHECK(count_elements(adapter::kTriangle3) == triangles);
  CHECK(count_elements(adapter::kQuad4) == 0);
}

TEST_CASE("recombine: nodes of CAD surfaces keep parameters, and a volume can be meshed on the quads") {
  const RunningGmsh gmsh;
  ::gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
  ::gmsh::model::occ::synchronize();
  ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.25);
  ::gmsh::model::mesh::generate(2);
  CHECK(recombine().count(SurfaceOutcome::converted) == 6);
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
  CHECK(recombine().surfaces.empty());
}
