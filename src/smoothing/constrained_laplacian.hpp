// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Constrained Laplacian smoothing [thesis 2.2.6; after Canann, Tristano, Staten].

#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::smoothing {

/// What moving a node does to the elements around it.
struct Change {
  int elements = 0;
  int better = 0, worse = 0;            ///< by the distortion metric
  int much_better = 0, much_worse = 0;  ///< from turned over to poor (under MYMIN) to fair, or back
  double mean_change = 0;
  double largest_angle = 0;  ///< afterwards, radians
  bool inverts = false;      ///< an element that was valid is not valid any more
};

/// The rule of acceptance [Canann98]: refused if all elements get worse, one is inverted, more get much worse
/// than much better, the mean falls by more than MYMIN or an angle is over THETAMAX; then accepted if all get
/// better, some much better and none much worse, or not more much worse than much better.
bool is_acceptable(const Change& change, const ThesisSmoothing& options);

/// Moves v to the mean of its neighbours, or as much of the way as is acceptable, halving. Returns how far it
/// moved, relative to the mean edge at v; 0 if v is not free.
double move_to_neighbours(kernel::Mesh& mesh, Index v, const ThesisSmoothing& options);

}  // namespace qmorph::smoothing
