// SPDX-License-Identifier: GPL-2.0-or-later
// Where nothing was found nobody looks again until something has changed there.
#include "cleanup/refused.hpp"

#include <doctest/doctest.h>

#include "cleanup/replace_cavities.hpp"
#include "cleanup/rings.hpp"
#include "smoothing/smooth.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using cleanup::Refused;

constexpr Index kSide = 21;  // nodes of a grid
constexpr std::size_t kNearby = 25;

Index node(Index x, Index y) { return y * kSide + x; }

void move(Mesh& mesh, Index v) {
  mesh.begin();
  mesh.set_point(v, mesh.point(v) + Vec2(0.1, 0.1));
  mesh.commit();
}

}  // namespace

TEST_CASE("refused: it holds where nothing was found, as long as no node nearby moves") {
  Mesh mesh = quad_grid(kSide - 1, kSide - 1);
  Refused refused(mesh);
  const Index here = node(10, 10), far = node(2, 2);
  CHECK_FALSE(refused.holds(here, kNearby));
  refused.note(here), refused.note(far);
  CHECK(refused.holds(here, kNearby));
  move(mesh, node(11, 9));
  refused.note_change();
  CHECK_FALSE(refused.holds(here, kNearby));
  CHECK(refused.holds(far, kNearby));
  CHECK_FALSE(refused.holds(node(11, 9), kNearby));
  refused.note(here);
  CHECK(refused.holds(here, kNearby));
}

TEST_CASE("refused: it does not hold where a node of the boundary gets another edge") {
  Mesh mesh = quad_grid(kSide - 1, kSide - 1);
  Refused refused(mesh);
  const Index corner = node(0, 0), here = node(2, 1), far = node(15, 15);
  refused.note(here), refused.note(far);
  mesh.begin();
  const Index h = edge(mesh, corner, node(1, 0));
  mesh.split_face(h, mesh.next(mesh.next(h)));
  mesh.commit();
  refused.note_change();
  CHECK_FALSE(refused.holds(here, kNearby));
  CHECK(refused.holds(far, kNearby));
}

TEST_CASE("refused: cavities at such nodes are not tried again, and are once something has changed") {
  Mesh mesh = filled_polygon({6, 6, 6});
  smoothing::smooth(mesh, {});
  Refused refused(mesh);
  cleanup::replace_cavities(mesh, {}, {}, {}, &refused);
  REQUIRE(irregular_nodes(mesh) == 1);
  const std::size_t tried = mesh.work();
  cleanup::replace_cavities(mesh, {}, {}, {}, &refused);
  CHECK(mesh.work() == tried);
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v) && mesh.is_free(v) && mesh.valence(v) != 4) {
      mesh.begin();
      mesh.set_point(v, mesh.point(v));
      mesh.commit();
      refused.note_change();
    }
  const std::size_t before = mesh.work();
  cleanup::replace_cavities(mesh, {}, {}, {}, &refused);
  CHECK(mesh.work() > before);
}
