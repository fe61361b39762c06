// SPDX-License-Identifier: GPL-2.0-or-later
#include "hard_inputs.hpp"

#include <numbers>

#include "curved_shapes.hpp"
#include "hard_shapes.hpp"
#include "sheets.hpp"

namespace benchmark {

std::vector<HardInput> hard_inputs() {
  const auto random = [] { return Random(1); };
  const auto make = [&](int columns, int rows, double jitter) {
    Random own = random();
    return lattice(columns, rows, jitter, own);
  };
  return {
      {"lattice stretched 5 to 1", [=] { return std::vector{scaled(holes(100, 100, 20), 5, 1)}; }},
      {"lattice stretched 30 to 1", [=] { return std::vector{scaled(holes(100, 100, 20), 30, 1)}; }},
      {"right triangles stretched 100 to 1", [=] { return std::vector{scaled(grid(100, 100), 100, 1)}; }},
      {"right triangles stretched 100 to 1, a small surface",
       [=] { return std::vector{scaled(grid(25, 25), 100, 1)}; }},
      {"lattice stretched ten thousand to 1", [=] { return std::vector{scaled(make(70, 70, 0.2), 1e4, 1)}; }},
      {"needles, 26 million to 1, with lines",
       [=] {
         Random r(2);
         return std::vector{with_lines(scaled(make(60, 47, 0.2), 26e6, 1), 0.2, r)};
       }},
      {"aspects up to 600, with lines", [=] { return std::vector{uneven_stretch()}; }},
      {"boundary layer, heights from 1e-6", [=] { return std::vector{boundary_layer()}; }},
      {"10 000 triangles at an inner node", [=] { return std::vector{fan(10000, true)}; }},
      {"10 000 triangles at a node of the outline", [=] { return std::vector{fan(10000, false)}; }},
      {"100 fans of 160 triangles", [=] { return std::vector{many_fans(10, 40)}; }},
      {"two lines a thousandth apart", [=] { return std::vector{close_lines(1e-3, 5e-3)}; }},
      {"10 000 lines",
       [=] {
         Random r(2);
         return std::vector{with_lines(make(150, 150, 0.15), 0.15, r)};
       }},
      {"30 % of the edges are lines",
       [=] {
         Random r(2);
         return std::vector{with_lines(make(100, 100, 0.15), 0.3, r)};
       }},
      {"all nodes embedded",
       [=] {
         Random r(2);
         return std::vector{with_fixed_nodes(make(100, 100, 0.2), 1, r)};
       }},
      {"a third of the nodes embedded",
       [=] {
         Random r(2);
         return std::vector{with_fixed_nodes(make(100, 100, 0.2), 0.33, r)};
       }},
      {"a region for each triangle",
       [=] {
         Random r(2);
         return std::vector{with_lines(make(220, 220, 0.15), 1, r)};
       }},
      {"triangles of three surfaces, mixed at random",
       [=] {
         Random r(2);
         return scattered_surfaces(make(100, 100, 0.15), 3, r);
       }},
      {"40 000 surfaces of two triangles",
       [=] {
         const Patch patch = grid(200, 200);
         std::vector<Index> part_of;
         for (Index t = 0; t < patch.triangles.size(); ++t) part_of.push_back(t / 2);
         return split(patch, part_of, Index(patch.triangles.size() / 2));
       }},
      {"4 000 ragged surfaces of five triangles",
       [=] {
         Random r(2);
         return ragged_pieces(make(100, 100, 0.2), 1.5, r);
       }},
      {"1 000 ragged surfaces of twenty triangles",
       [=] {
         Random r(2);
         return ragged_pieces(make(100, 100, 0.2), 3, r);
       }},
      {"250 ragged surfaces of eighty triangles",
       [=] {
         Random r(2);
         return ragged_pieces(make(100, 100, 0.2), 6, r);
       }},
      {"polygon cut at random",
       [=] {
         Random r(2);
         return std::vector{cut_polygon(5000, r, 0)};
       }},
      {"polygon cut evenly",
       [=] {
         Random r(2);
         return std::vector{cut_polygon(5000, r, 1)};
       }},
      {"strip of one row",
       [=] {
         Random r(2);
         return std::vector{strip(10000, 1.1, r)};
       }},
      {"strip of one row, far too thin",
       [=] {
         Random r(2);
         return std::vector{strip(5000, 50, r)};
       }},
      {"strip of one row, far too wide",
       [=] {
         Random r(2);
         return std::vector{strip(5000, 0.02, r)};
       }},
      {"spikes along the outline", [=] { return std::vector{spikes(3000, 2, 6)}; }},
      {"notches along the outline", [=] { return std::vector{notches(2000)}; }},
      {"one node in nine is a hole", [=] { return std::vector{holes(150, 150, 3)}; }},
      {"maze of triangles",
       [=] {
         Random r(2);
         return std::vector{maze(150, 150, 0.8, r)};
       }},
      {"spiral two triangles wide", [=] { return std::vector{spiral(0.5, 16)}; }},
      {"star of a cloud of points", [=] { return std::vector{star(60, 20000)}; }},
      {"comb, teeth of two long triangles", [=] { return std::vector{comb(700)}; }},
      {"sizes from 1 to a million", [=] { return std::vector{graded(220, 100, 1e6)}; }},
      {"cloud of points",
       [=] {
         Random r(2);
         return std::vector{delaunay(cloud(10000, r))};
       }},
      {"edges turned at random", [=] { return std::vector{turned(100, 100)}; }},
      {"half of it quads already", [=] { return std::vector{mixed(120, 120, 0.3)}; }},
      {"curved: half a cylinder",
       [=] { return std::vector{bent(make(120, 120, 0.15), roll(120 / std::numbers::pi))}; }},
      {"curved: waves", [=] { return std::vector{bent(make(120, 120, 0.15), waves(40, 4))}; }},
      {"curved: tube",
       [=] {
         Random r(2);
         return std::vector{tube(100, 140, 0.15, r)};
       }},
      {"curved: torus",
       [=] {
         Random r(2);
         return std::vector{torus(240, 60, 0.15, r)};
       }},
      {"curved: closed sphere",
       [=] {
         Random r(2);
         return std::vector{sphere(60, 0.15, r)};
       }},
      {"curved: 100 ragged surfaces of 280 triangles",
       [=] {
         Random r(2);
         std::vector<Patch> pieces = ragged_pieces(make(120, 120, 0.15), 11, r);
         for (Patch& piece : pieces) piece = bent(std::move(piece), waves(40, 4));
         return pieces;
       }},
  };
}

}  // namespace benchmark
