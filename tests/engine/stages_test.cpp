// The figures after each stage.
#include <doctest/doctest.h>

#include <cmath>

#include "qmorph/convert.hpp"
#include "qmorph/quality.hpp"
#include "support/domains.hpp"

using qmorph::Stage;

namespace {

qmorph::QuadMesh convert_measured(const qmorph::Patch& patch) {
  qmorph::Options options;
  options.measure_stages = true;
  return qmorph::convert(patch, options);
}

}  // namespace

TEST_CASE("stages: the first is the input and the last is the result") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    const qmorph::Patch patch = qmorph::test::random_domain(seed).patch;
    const qmorph::QuadMesh mesh = convert_measured(patch);
    REQUIRE(mesh.stats.stages.size() == qmorph::kStages);
    const qmorph::Quality input = mesh.stats.stages.front().quality.result();
    CHECK(input.triangles == patch.triangles.size());
    CHECK(input.quads == patch.quads.size());
    CHECK(input.triangle_metric_min <= input.triangle_metric_mean);
    const qmorph::Quality last = mesh.stats.stages.back().quality.result(), result = qmorph::measure(mesh);
    CHECK(last.quads == result.quads);
    CHECK(last.triangles == result.triangles);
    CHECK(last.valence == result.valence);
    CHECK(last.scaled_jacobian_min == doctest::Approx(result.scaled_jacobian_min));
    CHECK(last.thesis_mean == doctest::Approx(result.thesis_mean));
  }
}

TEST_CASE("stages: measuring changes no result, and nothing is measured that was not asked for") {
  const qmorph::Patch patch = qmorph::test::random_domain(3).patch;
  const qmorph::QuadMesh measured = convert_measured(patch), plain = qmorph::convert(patch);
  CHECK(plain.stats.stages.empty());
  CHECK(measured.quads == plain.quads);
  CHECK(measured.points == plain.points);
}

TEST_CASE("stages: the front leaves what elimination joins") {
  const qmorph::QuadMesh mesh = convert_measured(qmorph::test::random_domain(3).patch);
  const auto after = [&](Stage stage) { return mesh.stats.stages[std::size_t(stage)].quality.result(); };
  CHECK(after(Stage::front).quads == mesh.stats.front_quads);
  CHECK(after(Stage::front).triangles == mesh.stats.leftover_triangles);
  CHECK(after(Stage::elimination).triangles <= mesh.stats.odd_regions);
}
