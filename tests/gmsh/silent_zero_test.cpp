// SPDX-License-Identifier: GPL-2.0-or-later
/// No success is reported where there is none: elements that are not in the file, parts that are not connected, options
/// that made no difference.

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/element_types.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"
#include "support/rng.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

constexpr const char* kTwoRectangles =
    "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\nRectangle(2) = {1, 0, 0, 1, 1};\nCoherence;\n"
    "Mesh.MeshSizeMax = 0.3;\n";

/// Several grids in one file, each with nodes of its own, on the surfaces 1, 2, ...
std::string msh_of(const std::vector<Grid>& grids, bool one_surface = false) {
  std::vector<std::array<double, 3>> nodes;
  std::vector<std::string> elements;
  for (std::size_t g = 0; g < grids.size(); ++g) {
    Grid grid = grids[g];
    grid.first_node = int(nodes.size()) + 1;
    const auto more = grid.nodes();
    nodes.insert(nodes.end(), more.begin(), more.end());
    for (const auto& triangle : grid.triangles())
      elements.push_back(row("2 2 0 " + std::to_string(one_surface ? 1 : g + 1), triangle));
  }
  return msh22(nodes, elements);
}

}  // namespace

TEST_CASE("silent zero: surfaces that the file does not have are named, and not counted") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", std::string(kTwoRectangles) + "Physical Surface(\"left\", 7) = {1};\n");
  for (const std::string name : {"out.msh", "out.vtk", "out.msh2"}) {
    CAPTURE(name);
    const Result result = run_qmorph({directory / "in.geo", "-o", directory / name});
    CHECK(result.status == 0);
    CHECK(mentions(result.err, "warning: surfaces in no physical group are not written to " + (directory / name) +
                                   ": 2 (-setnumber Mesh.SaveAll 1 writes all)\n"));
    CHECK(!mentions(result.err, "surface 2: "));
    CHECK(mentions(result.err, "-> 25 quads"));
    const Result all = run_qmorph({directory / "in.geo", "-o", directory / name, "-save_all"});
    CHECK(all.status == 0);
    CHECK(!mentions(all.err, "not written"));
    CHECK(mentions(all.err, "-> 50 quads"));
    const Snapshot after = read_snapshot(directory / name);
    std::size_t quads = 0;
    for (const auto& entity : after.mesh.entities)
      if (const auto* block = entity.block(adapter::kQuad4)) quads += block->tags.size();
    CHECK(quads == 50);
  }
}

TEST_CASE("silent zero: a file without a quad is not written") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", std::string(kTwoRectangles) + "Physical Curve(\"wall\", 7) = {1};\n");
  for (const std::vector<std::string>& words : {std::vector<std::string>{}, {"--for", "elmer"}}) {
    std::vector<std::string> all = {directory / "in.geo", "-o", directory / "out.msh"};
    all.insert(all.end(), words.begin(), words.end());
    const Result result = run_qmorph(all);
    CHECK(result.status == 2);
    CHECK(mentions(result.err, "out.msh would have no quad; add Physical Surface, or -setnumber Mesh.SaveAll 1\n"));
    CHECK_FALSE(std::filesystem::exists(directory / "out.msh"));
    all.insert(all.end(), {"-setnumber", "Mesh.SaveAll", "1"});
    CHECK(run_qmorph(all).status == 0);
    CHECK(mentions(read_file(directory / "out.msh"), "\"wall\""));
    std::filesystem::remove(directory / "out.msh");
  }
}

TEST_CASE("silent zero: groups of volumes are meant for -3, and leave nothing out of a mesh of surfaces") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo",
             std::string("SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\nMesh.MeshSizeMax = 0.5;\n") +
                 "Physical Volume(\"solid\", 7) = {1};\n");
  for (const std::string name : {"out.msh", "out.vtk", "out.msh2"}) {
    CAPTURE(name);
    const Result result = run_qmorph({directory / "in.geo", "-o", directory / name});
    CHECK(result.status == 0);
    CHECK(mentions(result.err, "warning: only volumes are in physical groups: all elements are written"));
    CHECK(!mentions(result.err, "not written"));
    std::size_t quads = 0;
    for (const auto& entity : read_snapshot(directory / name).mesh.entities)
      if (const auto* block = entity.block(adapter::kQuad4)) quads += block->tags.size();
    CHECK(quads >= 24);
  }
  CHECK(mentions(read_file(directory / "out.msh"), "\"solid\""));
}

TEST_CASE("silent zero: triangles that share no nodes are reported, with how many nodes could be merged") {
  const TemporaryDirectory directory;
  const Grid grid{.n = 6};
  std::vector<std::array<double, 3>> nodes;
  std::vector<std::string> elements;
  for (const auto& triangle : grid.triangles()) {
    for (const int node : triangle) nodes.push_back(grid.nodes()[std::size_t(node - 1)]);
    const int last = int(nodes.size());
    elements.push_back(row<3>("2 2 0 1", {last - 2, last - 1, last}));
  }
  write_file(directory / "in.msh", msh22(nodes, elements));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(mentions(result.err, "warning: 167 nodes lie where another one is"));  // 216 at 49 places
  CHECK(mentions(result.err, "Coherence Mesh;"));
  // What the message says helps.
  write_file(directory / "joined.geo", "Merge \"in.msh\";\nCoherence Mesh;\n");
  const Result joined = run_qmorph({directory / "joined.geo", "-o", directory / "out.msh"});
  CHECK(joined.status == 0);
  CHECK(!mentions(joined.err, "warning"));
  CHECK(mentions(joined.err, "72 triangles -> 36 quads"));
}

TEST_CASE("silent zero: parts side by side are warned of only if they share no nodes") {
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", msh_of({Grid{}, Grid{.x = 1}}));
  CHECK(mentions(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).err, "warning: 5 nodes lie where"));
  write_file(directory / "a.msh", msh_of({Grid{}}));
  write_file(directory / "b.msh", msh_of({Grid{.x = 1}}));
  const Result merged = run_qmorph({directory / "a.msh", directory / "b.msh", "-o", directory / "out.msh"});
  CHECK(mentions(merged.err, "warning: 5 nodes lie where"));
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  CHECK(!mentions(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).err, "warning"));
  write_file(directory / "in.msh", msh_of({Grid{}, Grid{.x = 1.5}, Grid{.z = 1}}));
  CHECK(!mentions(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).err, "warning"));
}

TEST_CASE("silent zero: triangles that share a node only do not lie on top of one another, whatever their numbers") {
  const TemporaryDirectory directory;
  write_file(directory / "in.msh",
             msh22({{0, 0, 0}, {4, 1, 0}, {2, 2, 0}, {3, 6, 0}, {0.5, 3, 0}}, {"2 2 0 1 1 2 3", "2 2 0 1 1 4 5"}));
  CHECK(!mentions(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).err, "lies over"));
}

TEST_CASE("silent zero: a STEP file whose faces were not fused") {
  const TemporaryDirectory directory;
  {
    const adapter::Session session;
    ::gmsh::model::occ::addRectangle(0, 0, 0, 1, 1);
    ::gmsh::model::occ::addRectangle(1, 0, 0, 1, 1);
    ::gmsh::model::occ::synchronize();
    ::gmsh::write(directory / "in.step");
  }
  const Result result = run_qmorph({directory / "in.step", "-clmax", "0.25"});
  CHECK(result.status == 0);
  CHECK(mentions(result.err, "nodes lie where another one is"));
  CHECK(mentions(result.err, "'Coherence;' in the script"));
}

TEST_CASE("silent zero: sheets that lie on top of one another are reported, wherever they lie") {
  const TemporaryDirectory directory;
  for (int seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    Rng rng(std::uint64_t(seed) + 1);
    // Side by side if the second one begins behind the end of the first.
    const double x = 0.1 * rng.range(1, 19);
    const int fine = rng.range(1, 8);
    const bool overlaps = x < 1;
    write_file(directory / "in.msh", msh_of({Grid{}, Grid{.n = fine, .x = x}}, seed % 2 == 0));
    const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
    CAPTURE(result.err);
    CHECK(mentions(result.err, "lies over another one") == overlaps);
  }
}

TEST_CASE("silent zero: options that make no difference are named") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  const Result mesh = run_qmorph(
      {directory / "in.msh", "-clmax", "3", "-setnumber", "Mesh.MeshSizeMin", "2", "-o", directory / "a.msh"});
  CHECK(mesh.status == 0);
  CHECK(mentions(mesh.err, "warning: Gmsh has nothing to mesh, and -clmax, Mesh.MeshSizeMin are ignored"));
  write_file(directory / "in.geo", std::string(kTwoRectangles) + "Mesh.SubdivisionAlgorithm = 1;\n");
  const Result script = run_qmorph({directory / "in.geo", "-clmax", "0.4"});
  CHECK(mentions(script.err, "warning: Mesh.SubdivisionAlgorithm is ignored"));
  CHECK(!mentions(script.err, "clmax"));
}

TEST_CASE("silent zero: -order lowers the order of a mesh, and says that it does not raise one above 1") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [] {
    build_two_squares();
    ::gmsh::model::mesh::setOrder(2);
  });
  const auto order_of = [](const std::string& path) {
    const Snapshot snapshot = read_snapshot(path);
    int order = 0;
    for (const auto& entity : snapshot.mesh.entities)
      for (const auto& block : entity.blocks) order = std::max(order, block.order);
    return order;
  };
  REQUIRE(order_of(directory / "in.msh") == 2);
  for (const auto& [order, expected] : {std::pair("1", 1), {"2", 2}, {"3", 2}}) {
    CAPTURE(order);
    const Result result = run_qmorph({directory / "in.msh", "-order", order, "-o", directory / "out.msh"});
    CHECK(result.status == 0);
    CHECK(order_of(directory / "out.msh") == expected);
    CHECK(mentions(result.err, "warning: order 3 is ignored") == (order == std::string("3")));
  }
}
