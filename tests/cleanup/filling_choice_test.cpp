// SPDX-License-Identifier: GPL-2.0-or-later
// What the angles of an outline tell before any filling is looked for.
#include "cleanup/filling_choice.hpp"

#include <doctest/doctest.h>

#include "cleanup/rings.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

double least_misfit(const Mesh& mesh) { return cleanup::least_misfit(mesh, cleanup::Score(mesh)); }

}  // namespace

TEST_CASE("least misfit: none for a rectangle, and no filling of a whole region has less") {
  CHECK(least_misfit(quad_grid(6, 5)) == doctest::Approx(0).epsilon(1e-12));
  for (const auto& sides : {std::vector<int>{6, 6, 6}, {4, 4, 4, 4}, {6, 6, 6, 6, 6}}) {
    const Mesh mesh = filled_polygon(sides);
    const cleanup::Score score(mesh);
    cleanup::Cavity cavity(mesh);
    REQUIRE(cavity.start_with_all());
    const auto choices = cleanup::choose_fillings(mesh, score, cavity, 1000, double(cavity.faces().size())).best_first;
    REQUIRE_FALSE(choices.empty());
    for (const cleanup::FillingChoice& choice : choices)
      CHECK(cleanup::least_misfit(mesh, score) <= choice.misfit + 1e-9);
  }
}

TEST_CASE("least misfit: much where the boundary turns at many places") {
  Mesh mesh = quad_grid(20, 20);
  for (Index x = 1; x < 20; x += 2) mesh.set_point(x, mesh.point(x) + Vec2(0, 0.3));
  CHECK(least_misfit(mesh) > 0.02);
}
