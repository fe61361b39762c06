// SPDX-License-Identifier: GPL-2.0-or-later
// What is done in windows: irregular nodes that are far apart cancel.
#include "chart/window_work.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

#include "chart/curved_region.hpp"
#include "chart/fixture.hpp"
#include "chart/irregular_nodes.hpp"
#include "chart/windows.hpp"
#include "space/reference.hpp"
#include "support/surfaces.hpp"

using namespace qmorph;
using namespace qmorph::test;
using namespace qmorph::chart;

namespace {

/// Each triangle of a closed surface as three quads: every triangle has an irregular node in its middle.
CurvedRegion three_quads_each(const Patch& patch) {
  Patch halves;
  halves.points = patch.points;
  std::map<std::pair<Index, Index>, Index> middles;
  const auto middle = [&](Index a, Index b) {
    const auto [at, is_new] = middles.emplace(std::minmax(a, b), Index(halves.points.size()));
    if (is_new) halves.points.emplace_back(0.5 * (patch.points[a] + patch.points[b]));
    return at->second;
  };
  for (const auto& [a, b, c] : patch.triangles) {
    const Index centre = Index(halves.points.size());
    halves.points.emplace_back((patch.points[a] + patch.points[b] + patch.points[c]) / 3);
    const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    halves.quads.push_back({a, ab, centre, ca});
    halves.quads.push_back({b, bc, centre, ab});
    halves.quads.push_back({c, ca, centre, bc});
  }
  halves.triangles = space::Reference::with_halves(halves);
  halves.quads.clear();
  return std::move(curved_regions(halves, std::numbers::pi, 0).at(0));
}

std::size_t irregular(const SurfaceMesh& mesh) {
  const std::vector<char> is = irregular_nodes(mesh, {});
  return std::size_t(std::count(is.begin(), is.end(), 1));
}

}  // namespace

TEST_CASE("windows: irregular nodes cancel, quads stay valid, and the rim of a window stays as it is") {
  std::size_t before = 0, after = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Rng rng(seed);
    const CurvedRegion region = three_quads_each(seed % 2 ? sphere(0.25, rng) : torus(1, 0.4, 0.2, rng));
    SurfaceMesh mesh = region.start();
    const std::vector<Index> opposite = opposite_sides(mesh);
    std::vector<char> waiting = irregular_nodes(mesh, {});
    Budget budget(kPlenty);
    const std::vector<bool> no_walls(4 * mesh.faces.size(), false);
    const std::vector<Window> windows = take_windows(mesh, opposite, no_walls, {14, 9, 1500, true}, waiting, budget);
    REQUIRE_FALSE(windows.empty());
    std::vector<Reworked> done;
    for (const Window& window : windows) {
      const Piece& piece = window.laid_out->piece;
      auto work = cancel_in_window(*window.laid_out, Options(), {*region.background}, budget.left()).better;
      if (!work) continue;
      for (Index f = 0; f < work->mesh.face_slots(); ++f)
        if (work->mesh.is_live_face(f)) CHECK(work->mesh.is_valid_face(f));
      for (Index side = 0; side < piece.open.size(); ++side)
        if (const Index v = piece.faces[side / 4][side % 4]; piece.open[side]) {
          REQUIRE(work->mesh.is_live_vertex(v));
          CHECK(work->lifted.points[v] == piece.points[v]);
        }
      done.push_back(std::move(*work));
    }
    before += irregular(mesh);
    const SurfaceMesh cleaned = replace(mesh, done);
    after += irregular(cleaned);
    std::size_t unpaired = 0;
    for (Index other : opposite_sides(cleaned)) unpaired += other == kNone;
    CHECK(unpaired == 0);  // the surfaces are closed
  }
  CHECK(double(after) < 0.9 * double(before));
}
