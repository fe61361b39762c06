// SPDX-License-Identifier: GPL-2.0-or-later
#include "hard_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "curved_shapes.hpp"
#include "hard_shapes.hpp"
#include "sheets.hpp"

namespace benchmark {

double Size::each_way(double usual) const { return usual * std::sqrt(share); }
int Size::each_way(int usual) const { return std::max(1, int(std::lround(each_way(double(usual))))); }
int Size::along(int usual) const { return std::max(1, int(std::lround(share * usual))); }

std::vector<HardInput> hard_inputs() {
  const auto make = [](int columns, int rows, double jitter) {
    Random random(1);
    return lattice(columns, rows, jitter, random);
  };
  return {
      {"lattice stretched 5 to 1",
       [=](const Size& size) { return std::vector{scaled(holes(size.each_way(100), size.each_way(100), 20), 5, 1)}; }},
      {"lattice stretched 30 to 1",
       [=](const Size& size) { return std::vector{scaled(holes(size.each_way(100), size.each_way(100), 20), 30, 1)}; }},
      {"right triangles stretched 100 to 1",
       [=](const Size& size) { return std::vector{scaled(grid(size.each_way(100), size.each_way(100)), 100, 1)}; }},
      {"right triangles stretched 100 to 1, a sixteenth",
       [=](const Size& size) { return std::vector{scaled(grid(size.each_way(25), size.each_way(25)), 100, 1)}; }},
      {"lattice stretched ten thousand to 1",
       [=](const Size& size) { return std::vector{scaled(make(size.each_way(70), size.each_way(70), 0.2), 1e4, 1)}; }},
      {"needles, 26 million to 1, with lines",
       [=](const Size& size) {
         Random r(2);
         return std::vector{with_lines(scaled(make(size.each_way(60), size.each_way(47), 0.2), 26e6, 1), 0.2, r)};
       }},
      {"aspects up to 600, with lines",
       [=](const Size& size) { return std::vector{uneven_stretch(size.each_way(60), size.each_way(46))}; }},
      {"boundary layer, heights from 1e-6",
       [=](const Size& size) { return std::vector{boundary_layer(size.each_way(160), size.each_way(60))}; }},
      {"all triangles at an inner node",
       [=](const Size& size) { return std::vector{fan(Index(size.along(10000)), true)}; }},
      {"all triangles at a node of the outline",
       [=](const Size& size) { return std::vector{fan(Index(size.along(10000)), false)}; }},
      {"fans of 160 triangles", [=](const Size& size) { return std::vector{many_fans(size.each_way(10), 40)}; }},
      {"two lines a fifth of an edge apart",
       [=](const Size& size) {
         return std::vector{close_lines(1e-3 / size.each_way(1.0), 5e-3 / size.each_way(1.0))};
       }},
      {"15 % of the edges are lines",
       [=](const Size& size) {
         Random r(2);
         return std::vector{with_lines(make(size.each_way(150), size.each_way(150), 0.15), 0.15, r)};
       }},
      {"30 % of the edges are lines",
       [=](const Size& size) {
         Random r(2);
         return std::vector{with_lines(make(size.each_way(100), size.each_way(100), 0.15), 0.3, r)};
       }},
      {"all nodes embedded",
       [=](const Size& size) {
         Random r(2);
         return std::vector{with_fixed_nodes(make(size.each_way(100), size.each_way(100), 0.2), 1, r)};
       }},
      {"a third of the nodes embedded",
       [=](const Size& size) {
         Random r(2);
         return std::vector{with_fixed_nodes(make(size.each_way(100), size.each_way(100), 0.2), 0.33, r)};
       }},
      {"a region for each triangle",
       [=](const Size& size) {
         Random r(2);
         return std::vector{with_lines(make(size.each_way(220), size.each_way(220), 0.15), 1, r)};
       }},
      {"triangles of three surfaces, mixed at random",
       [=](const Size& size) {
         Random r(2);
         return scattered_surfaces(make(size.each_way(100), size.each_way(100), 0.15), 3, r);
       }},
      {"surfaces of two triangles",
       [=](const Size& size) {
         const Patch patch = grid(size.each_way(200), size.each_way(200));
         std::vector<Index> part_of;
         for (Index t = 0; t < patch.triangles.size(); ++t) part_of.push_back(t / 2);
         return split(patch, part_of, Index(patch.triangles.size() / 2));
       }},
      {"ragged surfaces of five triangles",
       [=](const Size& size) {
         Random r(2);
         return ragged_pieces(make(size.each_way(100), size.each_way(100), 0.2), 1.5, r);
       }},
      {"ragged surfaces of twenty triangles",
       [=](const Size& size) {
         Random r(2);
         return ragged_pieces(make(size.each_way(100), size.each_way(100), 0.2), 3, r);
       }},
      {"ragged surfaces of eighty triangles",
       [=](const Size& size) {
         Random r(2);
         return ragged_pieces(make(size.each_way(100), size.each_way(100), 0.2), 6, r);
       }},
      {"polygon cut at random",
       [=](const Size& size) {
         Random r(2);
         return std::vector{cut_polygon(Index(size.along(5000)), r, 0)};
       }},
      {"polygon cut evenly",
       [=](const Size& size) {
         Random r(2);
         return std::vector{cut_polygon(Index(size.along(5000)), r, 1)};
       }},
      {"strip of one row",
       [=](const Size& size) {
         Random r(2);
         return std::vector{strip(size.along(10000), 1.1, r)};
       }},
      {"strip of one row, far too thin",
       [=](const Size& size) {
         Random r(2);
         return std::vector{strip(size.along(5000), 50, r)};
       }},
      {"strip of one row, far too wide",
       [=](const Size& size) {
         Random r(2);
         return std::vector{strip(size.along(5000), 0.02, r)};
       }},
      {"spikes along the outline", [=](const Size& size) { return std::vector{spikes(size.along(3000), 2, 6)}; }},
      {"notches along the outline", [=](const Size& size) { return std::vector{notches(size.along(2000))}; }},
      {"one node in nine is a hole",
       [=](const Size& size) { return std::vector{holes(size.each_way(150), size.each_way(150), 3)}; }},
      {"maze of triangles",
       [=](const Size& size) {
         Random r(2);
         return std::vector{maze(size.each_way(150), size.each_way(150), 0.8, r)};
       }},
      {"spiral two triangles wide", [=](const Size& size) { return std::vector{spiral(0.5, size.each_way(16))}; }},
      {"star of a cloud of points", [=](const Size& size) { return std::vector{star(60, size.along(20000))}; }},
      {"comb, teeth of two long triangles", [=](const Size& size) { return std::vector{comb(size.along(700))}; }},
      {"sizes from 1 to a million",
       [=](const Size& size) { return std::vector{graded(size.each_way(220), size.each_way(100), 1e6)}; }},
      {"cloud of points",
       [=](const Size& size) {
         Random r(2);
         return std::vector{delaunay(cloud(size.along(10000), r))};
       }},
      {"edges turned at random",
       [=](const Size& size) { return std::vector{turned(size.each_way(100), size.each_way(100))}; }},
      {"half of it quads already",
       [=](const Size& size) { return std::vector{mixed(size.each_way(120), size.each_way(120), 0.3)}; }},
      {"curved: half a cylinder",
       [=](const Size& size) {
         return std::vector{
             bent(make(size.each_way(120), size.each_way(120), 0.15), roll(size.each_way(120) / std::numbers::pi))};
       }},
      {"curved: waves",
       [=](const Size& size) {
         return std::vector{bent(make(size.each_way(120), size.each_way(120), 0.15), waves(40, 4))};
       }},
      {"curved: tube",
       [=](const Size& size) {
         Random r(2);
         return std::vector{tube(size.each_way(100), size.each_way(140), 0.15, r)};
       }},
      {"curved: torus",
       [=](const Size& size) {
         Random r(2);
         return std::vector{torus(size.each_way(240), 2 * size.each_way(30), 0.15, r)};
       }},
      {"curved: closed sphere",
       [=](const Size& size) {
         Random r(2);
         return std::vector{sphere(size.each_way(60), 0.15, r)};
       }},
      {"curved: ragged surfaces of 280 triangles",
       [=](const Size& size) {
         Random r(2);
         std::vector<Patch> pieces = ragged_pieces(make(size.each_way(120), size.each_way(120), 0.15), 11, r);
         for (Patch& piece : pieces) piece = bent(std::move(piece), waves(40, 4));
         return pieces;
       }},
  };
}

}  // namespace benchmark
