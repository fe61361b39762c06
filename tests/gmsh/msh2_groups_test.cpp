// SPDX-License-Identifier: GPL-2.0-or-later
/// MSH 2 gives a physical group to each element, Gmsh to each entity.

#include <doctest/doctest.h>

#include <map>
#include <sstream>
#include <string>

#include "gmsh/session/compat.hpp"
#include "gmsh/support.hpp"

using namespace qmorph::test;

namespace {

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// How many elements of each type, group and elementary tag an ASCII file of MSH 2.2 has.
std::map<std::string, int> count_elements(const std::string& text) {
  std::istringstream in(text.substr(text.find("$Elements")));
  std::map<std::string, int> counts;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string number, type, tags, group, elementary;
    if (words >> number >> type >> tags >> group >> elementary) ++counts[type + ' ' + group + ' ' + elementary];
  }
  return counts;
}

}  // namespace

TEST_CASE("groups of MSH 2: one elementary tag for several materials") {
  const TemporaryDirectory directory;
  const Grid grid;
  std::vector<std::string> elements;
  for (const auto& triangle : grid.triangles())
    elements.push_back(row(elements.size() < 16 ? "2 2 8 1" : "2 2 9 1", triangle));
  const auto outline = grid.outline();
  for (std::size_t i = 0; i < outline.size(); ++i) elements.push_back(row(i % 2 ? "1 2 3 1" : "1 2 4 1", outline[i]));
  const std::string names = "$PhysicalNames\n1\n2 9 \"copper\"\n$EndPhysicalNames\n";
  write_file(directory / "in.msh", msh22(grid.nodes(), elements, names));

  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  CHECK(mentions(result.err, "surface 2 \"copper\": 16 triangles -> 8 quads"));
  CHECK(mentions(read_file(directory / "out.msh"), names));
  const std::map<std::string, int> expected = {{"3 8 1", 8}, {"3 9 1", 8}, {"1 3 1", 8}, {"1 4 1", 8}};
  CHECK(count_elements(read_file(directory / "out.msh")) == expected);

  CHECK(run_qmorph({directory / "in.msh", "-format", "msh41", "-o", directory / "out41.msh"}).status == 0);
  const Snapshot after = read_snapshot(directory / "out41.msh");
  CHECK(after.groups.at({2, 9}).second == std::vector<int>{2});
  CHECK(element_counts(after, 2).second == 8);
}

TEST_CASE("groups of MSH 2: the same elements once for each group, as Gmsh writes them") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 2.2, false, [] {
    build_two_squares();
    ::gmsh::model::addPhysicalGroup(2, {1, 2}, 50);
    ::gmsh::model::addPhysicalGroup(1, {4}, 60);
  });
  const std::map<std::string, int> before = count_elements(read_file(directory / "in.msh"));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  const std::map<std::string, int> after = count_elements(read_file(directory / "out.msh"));
  CHECK(after.at("3 5 1") > 10);
  CHECK(after.at("3 5 1") == after.at("3 50 1"));
  CHECK(after.at("3 50 2") > 10);
  for (const char* kept : {"1 6 4", "1 60 4", "1 7 10", "15 8 20"}) CHECK(after.at(kept) == before.at(kept));

  CHECK(run_qmorph({directory / "in.msh", "-format", "msh41", "-o", directory / "out41.msh"}).status == 0);
  const Snapshot snapshot = read_snapshot(directory / "out41.msh");
  CHECK(snapshot.groups.at({2, 5}) == Snapshot::Group{"left", {1}});
  CHECK(snapshot.groups.at({2, 50}).second == std::vector<int>{1, 2});
}

TEST_CASE("groups of MSH 2: a binary file is read as the ASCII one is") {
  const TemporaryDirectory directory;
  for (bool binary : {false, true})
    make_msh(directory / (binary ? "b.msh" : "a.msh"), 2.2, binary, [] {
      build_two_squares();
      ::gmsh::model::addPhysicalGroup(2, {1, 2}, 50);
      ::gmsh::model::addPhysicalGroup(1, {4}, 60);
    });
  for (const char* name : {"a", "b"}) {
    const Result result = run_qmorph({directory / (name + std::string(".msh")), "-setnumber", "Mesh.Binary", "0", "-o",
                                      directory / (name + std::string(".out.msh"))});
    CAPTURE(result.err);
    CHECK(result.status == 0);
  }
  const Snapshot a = read_snapshot(directory / "a.out.msh"), b = read_snapshot(directory / "b.out.msh");
  REQUIRE(a.mesh.tags == b.mesh.tags);
  for (std::size_t row = 0; row < a.mesh.tags.size(); ++row)
    CHECK((a.mesh.points[row] - b.mesh.points[row]).norm() < 1e-12);  // Gmsh's ASCII has 16 digits
  CHECK(run_qmorph({directory / "b.msh", "-o", directory / "c.msh"}).status == 0);
  CHECK(mentions(read_file(directory / "c.msh"), "2.2 1 8"));
  CHECK(count_elements(read_file(directory / "a.out.msh")) == count_elements(read_file(directory / "b.out.msh")));
}

TEST_CASE("groups of MSH 2: a file with some elements twice and others once is refused") {
  const TemporaryDirectory directory;
  const Grid grid;
  std::vector<std::string> elements;
  for (const auto& triangle : grid.triangles()) elements.push_back(row("2 2 8 1", triangle));
  elements.push_back(row("2 2 9 1", grid.triangles().front()));
  write_file(directory / "in.msh", msh22(grid.nodes(), elements));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(result.status == 2);
  CHECK(mentions(result.err, "give each group its own elementary tag"));
  CHECK(directory.files() == std::vector<std::string>{"in.msh"});
}
