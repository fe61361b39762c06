// SPDX-License-Identifier: GPL-2.0-or-later
// What a rollback brings back, and what a commit keeps.
#include <doctest/doctest.h>

#include "kernel/random_edits.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

/// Edits drawn from `seed`, which ask for new elements and leave dead ones: they show the free lists.
void replay(Mesh& mesh, std::uint64_t seed, int edits) {
  Rng rng(seed);
  RandomEdits random(mesh, rng);
  for (int i = 0; i < edits; ++i) random.step();
}

/// RandomEdits uses transactions of its own to try things; inside one they have to stay out.
void edit_in_transaction(Mesh& mesh, Rng& rng, int edits) {
  for (int i = 0; i < edits; ++i) {
    const auto h = Index(rng.below(mesh.half_edge_slots()));
    if (!mesh.is_live_half_edge(h)) continue;
    const Index f = mesh.face(h), g = mesh.face(Mesh::twin(h));
    switch (rng.below(6)) {
      case 0:
        mesh.set_point(mesh.origin(h), mesh.point(mesh.origin(h)) + Vec2(rng.uniform(), -0.0));
        break;
      case 1:
        if (mesh.can_flip(h)) mesh.flip(h);
        break;
      case 2:
        if (mesh.can_collapse(h)) mesh.collapse(h);
        break;
      case 3:
        mesh.split_edge(h, mesh.point(mesh.origin(h)));
        break;
      case 4:
        if (mesh.is_triangle(f) && mesh.is_triangle(g) && mesh.valence(mesh.origin(h)) > 2 &&
            mesh.valence(mesh.target(h)) > 2)
          mesh.join_faces(h);
        break;
      default: {
        std::vector<Index> copies;
        if (f != kNone && mesh.degree(f) < 5) topology::pillow(mesh, {f}, copies);
      }
    }
  }
}

}  // namespace

TEST_CASE("rollback restores every bit, and the numbers that new elements will get") {
  int changed = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mesh(rng);
    replay(mesh, seed + 1, 20);  // so that there are dead slots
    for (int round = 0; round < 2; ++round) {
      Mesh untouched = mesh;
      const Snapshot before = snapshot(mesh);
      mesh.begin();
      CHECK(mesh.in_transaction());
      edit_in_transaction(mesh, rng, 25);
      changed += snapshot(mesh) != before;
      mesh.rollback();
      CHECK_FALSE(mesh.in_transaction());
      REQUIRE(snapshot(mesh) == before);
      REQUIRE(defect(mesh, false) == "");
      replay(mesh, seed + 2, 10);
      replay(untouched, seed + 2, 10);
      REQUIRE(snapshot(mesh) == snapshot(untouched));
    }
  }
  CHECK(changed > 780);  // nearly every round had something to undo
}

TEST_CASE("commit keeps the edits, and frees what died for new elements") {
  Mesh mesh = grid(2, 1, Diagonals::rising);
  //   3---4---5
  //   | / | / |
  //   0---1---2
  mesh.begin();
  mesh.join_faces(edge(mesh, 0, 4));
  const Index half_edges = mesh.half_edge_slots(), faces = mesh.face_slots();
  mesh.split_face(edge(mesh, 1, 4), edge(mesh, 3, 0));
  CHECK(mesh.half_edge_slots() == half_edges + 2);  // what died is not used again before the commit:
  CHECK(mesh.face_slots() == faces + 1);            // a rollback could not bring it back
  mesh.commit();
  CHECK(faces_of(mesh) == Polygons{{0, 1, 3}, {1, 2, 5}, {1, 4, 3}, {1, 5, 4}});
  mesh.join_faces(edge(mesh, 1, 3));
  mesh.split_face(edge(mesh, 0, 1), edge(mesh, 4, 3));
  CHECK(mesh.half_edge_slots() == half_edges + 2);
  CHECK(mesh.face_slots() == faces + 1);
  CHECK(defect(mesh) == "");
}

TEST_CASE("committed edits are the same as edits without a transaction, apart from the numbers of elements") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mesh(rng);
    std::vector<Index> flipped;
    Mesh plain = mesh;
    mesh.begin();
    for (int i = 0; i < 20; ++i) {
      const auto h = Index(rng.below(mesh.half_edge_slots()));
      if (!mesh.can_flip(h)) continue;
      mesh.flip(h), flipped.push_back(h);
    }
    mesh.commit();
    for (Index h : flipped) plain.flip(h);
    REQUIRE(snapshot(mesh) == snapshot(plain));
  }
}

TEST_CASE("rollback of nothing changes nothing, and a transaction may follow another") {
  Mesh mesh = quad_grid(2, 2);
  const Snapshot before = snapshot(mesh);
  mesh.begin();
  mesh.rollback();
  CHECK(snapshot(mesh) == before);
  mesh.begin();
  mesh.commit();
  CHECK(snapshot(mesh) == before);
  mesh.begin();
  mesh.set_point(4, {7, 7});
  mesh.commit();
  mesh.begin();
  mesh.set_point(4, {8, 8});
  mesh.set_point(4, {9, 9});
  mesh.rollback();
  CHECK(mesh.point(4) == Vec2(7, 7));
}

TEST_CASE("rollback takes back that a node was fixed") {
  Mesh mesh = quad_grid(2, 2);
  mesh.begin();
  mesh.set_fixed(4);
  mesh.rollback();
  CHECK_FALSE(mesh.is_fixed(4));
}

TEST_CASE("checked commits refuse elements that are invalid, and look only at those that were touched") {
  Mesh mesh = quad_grid(3, 3);
  mesh.set_point(5, {1.9, 1.9});  // not in a transaction: nobody looks
  mesh.check_commits(true);
  mesh.begin();
  mesh.set_point(10, {2.1, 2.1});  // the other end of the quad that is turned over now
  CHECK_THROWS_AS(mesh.commit(), std::logic_error);
  mesh.rollback();
  mesh.set_point(5, {1, 1});
  mesh.begin();
  mesh.set_point(10, {2.1, 2.1});
  mesh.commit();
  CHECK(defect(mesh) == "");
}
