// SPDX-License-Identifier: GPL-2.0-or-later
/// Quads that are there already, made better: qmorph::improve_quads() and --cleanup-only.

#include <doctest/doctest.h>

#include <string>

#include "gmsh/session/compat.hpp"
#include "gmsh/support.hpp"
#include "qmorph/gmsh.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

/// What Gmsh makes of two squares that share a curve. 0: simple, 1: Blossom.
void build_recombined(int algorithm) {
  build_two_squares();
  ::gmsh::option::setNumber("Mesh.RecombinationAlgorithm", algorithm);
  ::gmsh::model::mesh::recombine();
}

/// Four squares around a node, which has been pulled to `middle`.
std::string pulled_square(const std::array<double, 3>& middle) {
  std::vector<std::string> elements;
  const std::vector<std::array<int, 4>> quads = {{1, 2, 5, 4}, {2, 3, 6, 5}, {4, 5, 8, 7}, {5, 6, 9, 8}};
  for (const auto& quad : quads) elements.push_back(row("3 2 0 1", quad));
  return msh22({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, middle, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}},
               elements);
}

}  // namespace

TEST_CASE("improve_quads: Gmsh's quads become better ones, and nothing else changes") {
  for (const int algorithm : {0, 1}) {
    CAPTURE(algorithm);
    const TemporaryDirectory directory;
    make_msh(directory / "in.msh", 4.1, false, [&] { build_recombined(algorithm); });
    const RunningGmsh gmsh;
    ::gmsh::open(directory / "in.msh");
    const ModelReport report = session::improve_quads();
    ::gmsh::option::setNumber("Mesh.SaveAll", 1);
    ::gmsh::write(directory / "out.msh");
    const Snapshot before = read_snapshot(directory / "in.msh"), after = read_snapshot(directory / "out.msh");

    CHECK(report.count(SurfaceOutcome::converted) == 2);
    CHECK(report.surfaces[0].quads_in > 0);
    for (const SurfaceReport& surface : report.surfaces) {
      CHECK(surface.triangles_out <= surface.conversion.odd_regions);
      CHECK(surface.conversion.front_quads == 0);
    }
    CHECK(report.total.scaled_jacobian_min > 0.3);
    CHECK(difference(before, after, {1, 2}) == "");
  }
}

TEST_CASE("improve_quads: only the surfaces that are asked for") {
  const RunningGmsh gmsh;
  build_recombined(1);
  const auto tags_of = [](int surface) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    ::gmsh::model::mesh::getElements(types, tags, nodes, 2, surface);
    return std::make_pair(tags, nodes);
  };
  const auto before = tags_of(1);
  const ModelReport report = session::improve_quads({}, {2});
  CHECK(report.surfaces.size() == 1);
  CHECK(tags_of(1) == before);
}

TEST_CASE("--cleanup-only: quads that are turned over are untangled") {
  const TemporaryDirectory directory;
  std::array<double, 3> middle{};
  SUBCASE("a chevron") { middle = {1.7, 1.7, 0}; }
  SUBCASE("turned over") { middle = {2.5, 1.2, 0}; }
  write_file(directory / "in.msh", pulled_square(middle));
  CHECK(run_qmorph({directory / "in.msh", "-o", directory / "plain.msh"}).status == 3);
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--cleanup-only"});
  CHECK(result.status == 0);
  CHECK(result.err.find("4 quads -> 4 quads; scaled Jacobian min 1.000") != std::string::npos);
  CHECK(difference(read_snapshot(directory / "in.msh"), read_snapshot(directory / "out.msh"), {1}) == "");
}

TEST_CASE("--cleanup-only: what cannot be turned back is left, named with its place") {
  const TemporaryDirectory directory;
  // Two squares; a corner that both have, on the boundary, lies beyond the opposite side.
  write_file(directory / "in.msh", msh22({{0, 0, 0}, {1, 1.5, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}},
                                         {"3 2 0 1 1 2 5 6", "3 2 0 1 2 3 4 5"}));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--cleanup-only"});
  CHECK(result.status == 3);
  CHECK(result.err.find("(1, 1.5, 0)") != std::string::npos);
}

TEST_CASE("--cleanup-only: triangles alone are paired") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--cleanup-only"}).status == 0);
  CHECK(difference(read_snapshot(directory / "in.msh"), read_snapshot(directory / "out.msh"), {1, 2}) == "");
}

TEST_CASE("improve_quads: a quad whose nodes are not listed in order around it is named") {
  for (const double height : {0.0, 0.1})  // of a bowl
    for (const int corner : {0, 5, 2})    // cell at a corner, inside, at a rim
      for (const std::array<int, 4>& order : {std::array{0, 1, 3, 2}, {0, 2, 1, 3}}) {
        CAPTURE(height);
        CAPTURE(corner);
        CAPTURE(order[1]);
        Grid grid;
        auto nodes = grid.nodes();
        for (auto& p : nodes) p = {4 * p[0], 4 * p[1], height * 16 * (p[0] * p[0] + p[1] * p[1])};
        std::vector<std::string> elements;
        for (int j = 0; j < grid.n; ++j)
          for (int i = 0; i < grid.n; ++i) {
            std::array<int, 4> quad = {grid.node(i, j), grid.node(i + 1, j), grid.node(i + 1, j + 1),
                                       grid.node(i, j + 1)};
            if (i + 4 * j == corner) quad = {quad[order[0]], quad[order[1]], quad[order[2]], quad[order[3]]};
            elements.push_back(row("3 2 0 1", quad));
          }
        const TemporaryDirectory directory;
        write_file(directory / "in.msh", msh22(nodes, elements));
        const std::string quad = "quad " + std::to_string(corner + 1) + " ";
        for (const bool improves : {false, true}) {
          CAPTURE(improves);
          std::vector<std::string> words = {directory / "in.msh", "-o", directory / "out.msh"};
          if (improves) words.emplace_back("--cleanup-only");
          const Result result = run_qmorph(words);
          CHECK(result.status == 3);
          CHECK_MESSAGE(result.err.find(quad) != std::string::npos, result.err);
        }
        CHECK(run_qmorph({directory / "in.msh", "--check"}).status == 6);
      }
}
