// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/rework.hpp"

#include "chart/fixture.hpp"

using namespace qmorph;
using namespace qmorph::test;
using namespace qmorph::chart;

namespace {

/// Triangle 0 1 2 with a node 3 inside, and its corner 0 cut off by a chord from 1 to 2 if `rows` are 0 1 3 and 2 0 3.
struct Example {
  Start start;
  Piece piece;
  Reworked work;

  explicit Example(const std::vector<Index>& rows)
      : start({.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0.5}},
               .triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
               .quads = {},
               .constraints = {},
               .fixed = {}}),
        piece(start.mesh, start.opposite, {}, rows),
        work{&piece, {}, {piece.points, piece.on}} {
    std::vector<Vec2> flat;
    for (const auto& p : piece.points) flat.push_back(p.head<2>());
    work.mesh = piece.mesh(flat);
  }
};

}  // namespace

TEST_CASE("replace: a piece that would join two nodes by a second edge stays as it is") {
  Example e({0, 2});
  REQUIRE(e.start.mesh.faces.size() == 3);
  CHECK(replace_where_simple(e.start.mesh, {e.work}).faces.size() == 3);
  kernel::Mesh& mesh = e.work.mesh;
  for (Index h = 0; h < mesh.half_edge_slots(); h += 2) {
    if (mesh.is_boundary_edge(h)) continue;
    const Index a = mesh.prev(h), b = mesh.prev(kernel::Mesh::twin(h));
    mesh.join_faces(h);
    mesh.split_face(a, b);
    break;
  }
  CHECK_FALSE(folds_onto_itself(mesh, e.piece));
  CHECK(replace(e.start.mesh, {e.work}).faces != e.start.mesh.faces);
  CHECK(replace_where_simple(e.start.mesh, {e.work}).faces == e.start.mesh.faces);
}
