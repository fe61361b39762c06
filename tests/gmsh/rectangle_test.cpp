// SPDX-License-Identifier: GPL-2.0-or-later
/// A rectangle whose opposite sides have the same number of edges is a grid, and nothing is simpler to see.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "gmsh/session/compat.hpp"
#include "gmsh/support.hpp"

using namespace qmorph::test;
using nlohmann::json;

namespace {

std::string rectangle(int n, int m) {
  return fmt::format(R"(
    Mesh.Algorithm = 6;
    Point(1) = {{0, 0, 0, 1}}; Point(2) = {{{0}, 0, 0, 1}}; Point(3) = {{{0}, {1}, 0, 1}}; Point(4) = {{0, {1}, 0, 1}};
    Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 1}};
    Transfinite Curve {{1, 3}} = {0} + 1; Transfinite Curve {{2, 4}} = {1} + 1;
    Curve Loop(1) = {{1, 2, 3, 4}}; Plane Surface(1) = {{1}};
  )",
                     n, m);
}

json stats_of(const TemporaryDirectory& directory, const std::string& input) {
  const std::string stats = directory / "stats.json";
  REQUIRE(run_qmorph({input, "-o", directory / "out.msh", "--stats", stats}).status == 0);
  return json::parse(read_file(stats))["total"];
}

void check_grid(const json& total, int n, int m) {
  CHECK(total["quads"] == n * m);
  CHECK(total["triangles"] == 0);
  CHECK(total["irregular_nodes"] == 0);
  CHECK(total["valence_boundary"].size() == 1);
  CHECK(total["scaled_jacobian"]["min"].get<double>() > 0.98);
}

}  // namespace

TEST_CASE("a rectangle becomes a grid, from its geometry and from the triangles alone") {
  for (const auto& size : {std::pair{8, 4}, {20, 10}, {17, 6}, {40, 40}}) {
    const int n = size.first, m = size.second;
    CAPTURE(n);
    CAPTURE(m);
    const TemporaryDirectory directory;
    write_file(directory / "in.geo", rectangle(n, m));
    check_grid(stats_of(directory, directory / "in.geo"), n, m);
    make_msh(directory / "in.msh", 4.1, false, [&] {
      ::gmsh::merge(directory / "in.geo");
      ::gmsh::model::mesh::generate(2);
    });
    check_grid(stats_of(directory, directory / "in.msh"), n, m);
  }
}
