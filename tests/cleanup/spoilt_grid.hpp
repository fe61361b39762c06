// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "cleanup/operations.hpp"
#include "kernel/fixture.hpp"
#include "smoothing/smooth.hpp"
#include "topology/edits.hpp"

namespace qmorph::test {

/// A grid of quads whose connectivity has been changed here and there, for the worse as well.
inline Mesh spoilt_grid(Rng& rng) {
  constexpr int kChanges = 8, kAny = -100;
  Mesh mesh = quad_grid(6, 6);
  const cleanup::Score score(mesh);
  for (int i = 0; i < kChanges; ++i) {
    const auto v = Index(rng.below(mesh.vertex_slots()));
    if (!mesh.is_live_vertex(v)) continue;
    const auto candidates = cleanup::candidates_around(mesh, score, v, kAny);
    if (candidates.empty()) continue;
    std::vector<Index> nodes;
    mesh.begin();
    bool done = cleanup::apply(mesh, candidates[rng.below(candidates.size())], nodes);
    if (done) {
      topology::remove_doublets(mesh, nodes);
      done = smoothing::smooth_near(mesh, {}, nodes, 2);
    }
    done ? mesh.commit() : mesh.rollback();
  }
  smoothing::smooth(mesh, {});
  return mesh;
}

}  // namespace qmorph::test
