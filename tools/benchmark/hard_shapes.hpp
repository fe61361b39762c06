// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The shapes that hard inputs are made of.

#include <vector>

#include "sheets.hpp"

namespace benchmark {

Patch scaled(Patch patch, double x, double y);
/// Some of the inner edges become constraints.
Patch with_lines(Patch patch, double share, Random& random);
Patch with_fixed_nodes(Patch patch, double share, Random& random);
std::vector<Vector2d> cloud(int count, Random& random);
/// Aspects from 1 to about 600, in any direction, and lines here and there.
Patch uneven_stretch(int columns, int rows);
/// Rows of geometric heights on all four sides of a square hole, from 1e-6 of the outer ones.
Patch boundary_layer(int around, int rows);
/// All triangles meet at one node, in the middle or on the outline.
Patch fan(Index count, bool inside);
/// Square cells that share their sides, with a fan in each.
Patch many_fans(int each_way, int edges);
/// Two embedded lines across a square, `gap` apart; triangles grow away from them.
Patch close_lines(double gap, double size);
std::vector<Patch> scattered_surfaces(Patch patch, Index surfaces, Random& random);
/// Pieces with ragged outlines: each triangle goes to the nearest of the seeds, which lie one in each square of a grid.
std::vector<Patch> ragged_pieces(const Patch& patch, double width, Random& random);
/// A convex polygon of `count` nodes, cut by diagonals at random.
Patch cut_polygon(Index count, Random& random, double evenness);
/// Two rows of nodes, no two of them at the same abscissa.
Patch strip(int edges, double length_over_height, Random& random);
/// A lattice whose outer triangles all have a spike on them.
Patch spikes(int columns, int rows, double length);
/// A strip with a notch in every second edge on both sides.
Patch notches(int columns);
Patch holes(int columns, int rows, int period);
/// What is left of a lattice without many of its triangles: a maze that touches itself at nodes.
Patch maze(int columns, int rows, double share, Random& random);
Patch spiral(double width, int turns);
Patch star(int points, int count);
/// Teeth two edges wide; their sides are single long edges.
Patch comb(int teeth);
/// The conformal map exp, which keeps shapes.
Patch graded(int columns, int rows, double ratio);
/// An edge is turned wherever that leaves two triangles, good or bad.
Patch turned(int columns, int rows);
/// A share of the pairs of triangles is quads already.
Patch mixed(int columns, int rows, double share);

}  // namespace benchmark
