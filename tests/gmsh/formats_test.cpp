// SPDX-License-Identifier: GPL-2.0-or-later
/// Formats other than MSH: written, and read again by Gmsh, the mesh is the same.

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "gmsh/session/compat.hpp"
#include "gmsh/support.hpp"

using namespace qmorph::test;

namespace {

/// Two squares that share curve 2, all in groups.
constexpr const char* kSquares =
    "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\nRectangle(2) = {1, 0, 0, 1, 1};\nCoherence;\n"
    "Mesh.MeshSizeMax = 0.3;\nPhysical Surface(\"left\", 5) = {1};\nPhysical Surface(\"right\", 7) = {2};\n"
    "Physical Curve(\"wall\", 6) = {1, 4};\n";

/// Elements of each dimension, type and entity.
std::map<std::vector<int>, std::size_t> count_elements(const Snapshot& snapshot) {
  std::map<std::vector<int>, std::size_t> counts;
  for (const auto& entity : snapshot.mesh.entities)
    for (const auto& block : entity.blocks) counts[{entity.dim, block.type, entity.tag}] = block.tags.size();
  return counts;
}

/// How many elements the entities have. UNV numbers entities of all dimensions together.
std::multiset<std::vector<std::size_t>> sizes_of_entities(const Snapshot& snapshot) {
  std::multiset<std::vector<std::size_t>> sizes;
  for (const auto& [entity, count] : count_elements(snapshot))
    sizes.insert({std::size_t(entity[0]), std::size_t(entity[1]), count});
  return sizes;
}

/// Coordinates of the corners of all quads, rounded.
std::multiset<std::multiset<std::array<long, 2>>> places_of_quads(const Snapshot& snapshot) {
  std::multiset<std::multiset<std::array<long, 2>>> places;
  for (const auto& entity : snapshot.mesh.entities)
    for (const auto& block : entity.blocks)
      for (std::size_t i = 0; block.corners == 4 && i < block.nodes.size(); i += 4) {
        std::multiset<std::array<long, 2>> quad;
        for (std::size_t k = i; k < i + 4; ++k) {
          const auto& p = snapshot.mesh.points[snapshot.mesh.rows.find(block.nodes[k])];
          quad.insert({std::lround(1e5 * p.x()), std::lround(1e5 * p.y())});
        }
        places.insert(quad);
      }
  return places;
}

}  // namespace

TEST_CASE("formats: read again by Gmsh, entities and quads are those of the .msh") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquares);
  REQUIRE(run_qmorph({directory / "in.geo", "-o", directory / "out.msh"}).status == 0);
  const Snapshot expected = read_snapshot(directory / "out.msh");
  CHECK(count_elements(expected).size() == 4);
  for (const char* name : {"out.unv", "out.bdf", "out.mesh"}) {
    CAPTURE(std::string(name));
    REQUIRE(run_qmorph({directory / "in.geo", "-o", directory / name}).status == 0);
    const Snapshot found = read_snapshot(directory / name);
    CHECK((sizes_of_entities(found) == sizes_of_entities(expected)));
    CHECK((places_of_quads(found) == places_of_quads(expected)));
  }
  CHECK(count_elements(read_snapshot(directory / "out.mesh")) == count_elements(expected));
  for (const char* name : {"out.vtk", "out.diff"}) {  // they keep entities in other ways
    CAPTURE(std::string(name));
    REQUIRE(run_qmorph({directory / "in.geo", "-o", directory / name}).status == 0);
    CHECK((places_of_quads(read_snapshot(directory / name)) == places_of_quads(expected)));
  }
}

TEST_CASE("formats: groups are kept where the format has them") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquares);
  const struct {
    const char* name;
    std::vector<std::string> words;
  } kCases[] = {{"out.su2", {"NELEM= 50", "MARKER_TAG= wall"}},
                {"out.inp", {"ELSET=left", "ELSET=right", "ELSET=wall"}},
                {"out.unv", {"left", "right", "wall"}}};
  for (const auto& the_case : kCases) {
    CAPTURE(std::string(the_case.name));
    std::vector<std::string> words = {directory / "in.geo", "-o", directory / the_case.name};
    for (const char* option : {"Mesh.SaveGroupsOfElements", "Mesh.SaveGroupsOfNodes"})
      words.insert(words.end(), {"-setnumber", option, "1"});
    REQUIRE(run_qmorph(words).status == 0);
    for (const std::string& word : the_case.words)
      CHECK(read_file(directory / the_case.name).find(word) != std::string::npos);
  }
}

TEST_CASE("formats: tags are physical where Gmsh is asked for it") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquares);
  REQUIRE(run_qmorph({directory / "in.geo", "-o", directory / "out.mesh", "-setnumber", "Mesh.SaveElementTagType", "2"})
              .status == 0);
  const auto counts = count_elements(read_snapshot(directory / "out.mesh"));
  CHECK(counts.count({2, 3, 5}) == 1);
  CHECK(counts.count({2, 3, 7}) == 1);
}
