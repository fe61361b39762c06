// SPDX-License-Identifier: GPL-2.0-or-later
#include "smoothing/thesis_smoothing.hpp"

#include <algorithm>

#include "smoothing/constrained_laplacian.hpp"
#include "smoothing/distortion.hpp"
#include "smoothing/optimisation_based.hpp"
#include "smoothing/untangle.hpp"

namespace qmorph::smoothing {
namespace {

constexpr int kLaplacianMoves = 2;  // before optimisation, thesis 4.1.7

/// The nodes of the elements around v.
template <class Visit>
void visit_around(const kernel::Mesh& mesh, Index v, const Visit& visit) {
  for (Index h : mesh.around(v)) {
    visit(mesh.target(h));
    if (mesh.face(h) != kNone) visit(mesh.target(mesh.next(h)));
  }
}

}  // namespace

void smooth_by_thesis(kernel::Mesh& mesh, const ThesisSmoothing& options, const std::vector<Index>& nodes) {
  for (Index v : nodes)
    if (!mesh.is_valid_star(v)) untangle_node(mesh, v);
  std::vector<char> active(mesh.vertex_slots(), 1), moves(mesh.vertex_slots(), 0);
  for (int pass = 0; pass < options.most_passes; ++pass) {
    bool any = false;
    for (Index v : nodes) {
      if (!active[v]) continue;
      active[v] = 0;
      double moved = 0;
      if (moves[v] < kLaplacianMoves) {
        moved = move_to_neighbours(mesh, v, options);
        ++moves[v];
        // It must come to its second move to be optimised.
        active[v] = smallest_distortion_around(mesh, v, options.coincidence) < options.optimise_below;
      } else if (smallest_distortion_around(mesh, v, options.coincidence) < options.optimise_below) {
        moved = optimise_node(mesh, v, options);
      } else {
        moved = move_to_neighbours(mesh, v, options);
      }
      any = any || active[v] || moved > options.move_tolerance;
      if (moved <= options.move_tolerance) continue;
      active[v] = 1;
      visit_around(mesh, v, [&](Index u) { active[u] = 1; });
    }
    if (!any) break;
  }
}

}  // namespace qmorph::smoothing
