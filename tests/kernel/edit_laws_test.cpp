// SPDX-License-Identifier: GPL-2.0-or-later
// What must hold after any legal edits of any mesh.
#include <doctest/doctest.h>

#include "kernel/random_edits.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

constexpr std::uint64_t kSeeds = 400;

/// Faces after node a has been put onto node b: sides without length vanish, and so do faces of two.
Polygons merged(Polygons faces, Index a, Index b) {
  for (auto& face : faces) {
    std::replace(face.begin(), face.end(), a, b);
    face.erase(std::unique(face.begin(), face.end()), face.end());
    if (face.size() > 1 && face.front() == face.back()) face.pop_back();
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  }
  std::erase_if(faces, [](const auto& face) { return face.size() < 3; });
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace

TEST_CASE("random edits leave a legal mesh with the boundary, the counts and the Euler characteristic they should") {
  std::array<int, 8> done{};
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mesh(rng);
    const int euler = count(mesh).euler();
    RandomEdits edits(mesh, rng);
    REQUIRE(edits.wrong() == "");
    for (int i = 0; i < 40; ++i) {
      if (!edits.step()) continue;
      REQUIRE_MESSAGE(edits.wrong() == "", edits.last(), " as edit ", i);
      REQUIRE(wrong_with(faces_of(mesh)) == "");
      REQUIRE(count(mesh).euler() == euler);
    }
    for (std::size_t kind = 0; kind < done.size(); ++kind) done[kind] += edits.done(kind);
  }
  for (std::size_t kind = 0; kind < done.size(); ++kind) {
    CAPTURE(RandomEdits::kNames[kind]);
    CHECK(done[kind] > 50);
  }
}

TEST_CASE("can_collapse says yes only where the result is a mesh, and the result is the merged one") {
  int yes = 0, no = 0, needless = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mesh(rng);
    RandomEdits edits(mesh, rng);
    for (int i = 0; i < 20; ++i) edits.step();
    const Polygons before = faces_of(mesh);
    for (Index h = 0; h < mesh.half_edge_slots(); ++h) {
      if (!mesh.is_live_half_edge(h) || mesh.is_boundary(mesh.origin(h))) continue;
      CAPTURE(h);
      const Index a = mesh.origin(h), b = mesh.target(h);
      const Polygons expected = merged(before, a, b);
      if (mesh.can_collapse(h)) {
        mesh.begin();
        mesh.collapse(h);
        REQUIRE(faces_of(mesh) == expected);
        REQUIRE(wrong_with(expected) == "");
        REQUIRE(defect(mesh, false) == "");
        mesh.rollback();
        ++yes;
      } else {
        ++no;
        needless += wrong_with(expected).empty();
      }
    }
  }
  CHECK(yes > 2000);
  CHECK(no > 200);
  CAPTURE(needless);
  CHECK(needless < no / 2);  // it is no excuse to refuse everything
}

TEST_CASE("can_flip says yes exactly where two triangles, counter-clockwise and new, result") {
  int yes = 0, no = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mesh(rng);
    for (int i = 0; i < 30; ++i) {  // flips and quads; every face stays counter-clockwise
      const auto h = Index(rng.below(mesh.half_edge_slots()));
      if (mesh.can_flip(h)) mesh.flip(h);
    }
    for (Index h = 0; h < mesh.half_edge_slots(); ++h) {
      CAPTURE(h);
      const Index t = Mesh::twin(h);
      if (mesh.is_boundary_edge(h)) {
        CHECK_FALSE(mesh.can_flip(h));
        continue;
      }
      const Index a = mesh.origin(h), b = mesh.target(h), c = mesh.origin(mesh.prev(h)), d = mesh.origin(mesh.prev(t));
      const auto area = [&](Index u, Index v, Index w) {
        return cross(mesh.point(v) - mesh.point(u), mesh.point(w) - mesh.point(u));
      };
      const bool possible = area(a, d, c) > 1e-9 && area(d, b, c) > 1e-9 && mesh.find(c, d) == kNone;
      REQUIRE(mesh.can_flip(h) == possible);
      if (!possible) {
        ++no;
        continue;
      }
      ++yes;
      mesh.begin();
      mesh.flip(h);
      REQUIRE(defect(mesh) == "");
      REQUIRE(wrong_with(faces_of(mesh)) == "");
      mesh.rollback();
    }
  }
  CHECK(yes > 2000);
  CHECK(no > 500);
}

TEST_CASE("an edit and its inverse restore the mesh") {
  int tried = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mesh(rng);
    RandomEdits edits(mesh, rng);
    for (int i = 0; i < 15; ++i) edits.step();
    const Polygons before = faces_of(mesh);
    const Edges boundary = boundary_of(mesh);
    for (Index h = 0; h < mesh.half_edge_slots(); ++h) {
      if (!mesh.is_live_half_edge(h)) continue;
      CAPTURE(h);
      if (mesh.can_flip(h)) {
        const Index a = mesh.origin(h), b = mesh.target(h);
        for (int turn = 0; turn < 4; ++turn) mesh.flip(h);
        REQUIRE(mesh.origin(h) == a);
        REQUIRE(mesh.target(h) == b);
        REQUIRE(faces_of(mesh) == before);
        ++tried;
      }
      if (!mesh.is_boundary_edge(h)) {
        const Index b = mesh.target(h), m = mesh.split_edge(h, mesh.point(b));
        const Index back = edge(mesh, m, b);
        REQUIRE(mesh.can_collapse(back));
        mesh.collapse(back);
        REQUIRE(faces_of(mesh) == before);
      }
      const Index v = mesh.origin(h), x = mesh.target(h), k = mesh.rotate_ccw(mesh.rotate_ccw(h)), y = mesh.target(k);
      if (mesh.is_boundary(v) || k == h || x == y) continue;
      const Index w = mesh.open_quad(h, k, mesh.point(v));
      REQUIRE(defect(mesh, false) == "");
      mesh.split_face(edge(mesh, w, y), edge(mesh, v, x));
      const Index diagonal = edge(mesh, w, v);
      REQUIRE(mesh.can_collapse(diagonal));
      mesh.collapse(diagonal);
      REQUIRE(faces_of(mesh) == before);
    }
    REQUIRE(boundary_of(mesh) == boundary);
    REQUIRE(defect(mesh, false) == "");
  }
  CHECK(tried > 500);
}
