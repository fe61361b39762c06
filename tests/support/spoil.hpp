// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Makes a good test mesh a difficult one, and keeps it valid.

#include "support/draft.hpp"
#include "support/rng.hpp"

namespace qmorph::test {

/// Moves inner nodes about; no triangle gets flatter than `flattest`, unless it was so before.
void jitter_nodes(Draft& draft, Rng& rng, double amount, double flattest);

/// Flips edges that are not constraints at random, under the same limit.
void flip_edges(Draft& draft, Rng& rng, double share, double flattest);

/// Adds edge paths of the mesh to the constraints: they end anywhere, meet the boundary, cross one another.
void add_constraint_walks(Draft& draft, Rng& rng, int walks);

/// Adds the outline of a set of triangles: a closed loop, perhaps one that touches itself.
void add_constraint_loop(Draft& draft, Rng& rng);

/// Cuts the domain into materials along straight lines.
void add_material_borders(Draft& draft, Rng& rng, int lines);

/// Adds the boundary edges to the constraints, too, as line elements of a model do.
void add_boundary_constraints(Draft& draft);

/// Fixes inner nodes.
void fix_nodes(Draft& draft, Rng& rng, int count);

/// Merges pairs of triangles into quads: here and there, or all within a disk. Leaves at least one triangle.
void make_quads(Draft& draft, Rng& rng);

}  // namespace qmorph::test
