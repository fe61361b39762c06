// SPDX-License-Identifier: GPL-2.0-or-later
// What is told of the front, step by step.
#include <doctest/doctest.h>

#include <cmath>

#include "front/fixture.hpp"
#include "front/front.hpp"
#include "front/morph.hpp"
#include "support/watcher.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

std::set<std::array<Index, 4>> live_faces_of(const Mesh& mesh) {
  std::vector<std::array<Index, 4>> faces;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    std::array<Index, 4> face{kNone, kNone, kNone, kNone};
    Index h = mesh.half_edge(f);
    for (Index i = 0; i < mesh.degree(f); ++i, h = mesh.next(h)) face[i] = mesh.origin(h);
    faces.push_back(face);
  }
  return live_faces(faces);
}

/// Looks at the front after each step.
class ClosePlayer : public FrontPlayer {
 public:
  ClosePlayer(const FrontStart& start, const Mesh& mesh)
      : FrontPlayer(start), mesh_(mesh), front_(mesh, FrontOptions{}) {
    checks_each_step = true;
    check_front();
  }
  void step(const FrontStep& step) override {
    FrontPlayer::step(step);
    for (const auto& [h, edge] : front) {
      ++edges;
      if (!front_.contains(h)) {
        is_consistent = false;
        continue;
      }
      const front::State state = front_.state(h);
      is_consistent = is_consistent && edge.origin == mesh_.origin(h) && edge.target == mesh_.target(h);
      stale += edge.origin_corner != state.left || edge.target_corner != state.right;
    }
  }
  std::size_t edges = 0, stale = 0;

 private:
  const Mesh& mesh_;
  const front::Front front_;
};

struct CloseWatcher : Observer {
  explicit CloseWatcher(const Mesh& watched) : mesh(watched) {}
  std::unique_ptr<FrontObserver> front_starts(const FrontStart& start) override {
    return std::make_unique<ClosePlayer>(start, mesh);
  }
  const Mesh& mesh;
};

}  // namespace

TEST_CASE("observer: steps applied one after another make the mesh that the front made, to the bit") {
  int quads = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mesh(rng), unwatched = mesh;
    Watcher watcher;
    const auto watched = front::morph(mesh, {}, {.observer = &watcher});
    const auto& player = static_cast<const FrontPlayer&>(*watched);
    CHECK(live_faces(player.faces) == live_faces_of(mesh));
    for (Index v = 0; v < mesh.vertex_slots(); ++v)
      if (mesh.is_live_vertex(v)) CHECK(player.points[v] == mesh.point(v));
    quads += player.kinds.contains(StepKind::quad) ? player.kinds.at(StepKind::quad) : 0;
    CHECK(front::morph(unwatched, {}) == nullptr);
    CHECK(live_faces_of(unwatched) == live_faces_of(mesh));
  }
  CHECK(quads > 500);
}

TEST_CASE("observer: after each step the reported edges are the front, with their states") {
  std::size_t edges = 0;
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mesh(rng);
    CloseWatcher watcher(mesh);
    const auto watched = front::morph(mesh, {}, {.observer = &watcher});
    const auto& player = static_cast<const ClosePlayer&>(*watched);
    CHECK(player.is_consistent);
    CHECK(player.stale == 0);
    edges += player.edges;
  }
  CHECK(edges > 5000);
}

TEST_CASE("observer: one that returns nobody sees nothing, and changes nothing") {
  Rng rng(3);
  Mesh mesh = random_mesh(rng);
  Observer nobody;
  CHECK(front::morph(mesh, {}, {.observer = &nobody}) == nullptr);
}
