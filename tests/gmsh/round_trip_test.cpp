// SPDX-License-Identifier: GPL-2.0-or-later
/// What goes in must come out, but for the inside of the surfaces that are converted (I1, I7).

#include <doctest/doctest.h>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"

using namespace qmorph::test;

namespace {

/// Periodic pairs of nodes on curve 6, in order.
std::vector<std::pair<std::size_t, std::size_t>> periodic_pairs(const std::string& path) {
  const qmorph::adapter::Session session;
  qmorph::adapter::set_option("Mesh.IgnorePeriodicity", 0);
  qmorph::adapter::run_logged([&] { ::gmsh::open(path); });
  int master = 0;
  std::vector<std::size_t> nodes, master_nodes;
  std::vector<double> transformation;
  ::gmsh::model::mesh::getPeriodicNodes(1, 6, master, nodes, master_nodes, transformation, false);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < nodes.size(); ++i) pairs.emplace_back(nodes[i], master_nodes[i]);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

void build_periodic() {
  build_two_squares();
  ::gmsh::model::mesh::clear();
  ::gmsh::model::mesh::setPeriodic(1, {6}, {4}, {1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  ::gmsh::model::mesh::generate(2);
}

}  // namespace

TEST_CASE("round trip: two surfaces with groups, an embedded curve and point, in each version and encoding") {
  for (const double version : {2.2, 4.1})
    for (const bool binary : {false, true}) {
      CAPTURE(version);
      CAPTURE(binary);
      const TemporaryDirectory directory;
      make_msh(directory / "in.msh", version, binary, build_two_squares);
      const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
      CAPTURE(result.err);
      CHECK(result.status == 0);
      const Snapshot before = read_snapshot(directory / "in.msh"), after = read_snapshot(directory / "out.msh");
      CHECK(difference(before, after, {1, 2}) == "");
      CHECK(element_counts(after, 1).first <= 1);
      CHECK(element_counts(after, 1).second > 0);
      CHECK(read_file(directory / "in.msh").substr(0, 20) == read_file(directory / "out.msh").substr(0, 20));
      CHECK(directory.files() == std::vector<std::string>{"in.msh", "out.msh"});
    }
}

TEST_CASE("round trip: MSH 1, 3 and 4.0 stay what they are") {
  for (const double version : {1.0, 3.0, 4.0}) {
    CAPTURE(version);
    const TemporaryDirectory directory;
    make_msh(directory / "in.msh", version, false, [] {
      build_two_squares();
      ::gmsh::model::removePhysicalGroups({});
    });
    CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).status == 0);
    CHECK(difference(read_snapshot(directory / "in.msh"), read_snapshot(directory / "out.msh"), {1, 2},
                     Compare::coordinates) == "");
    const std::size_t format = version > 1 ? 20 : 4;  // version 1 begins with $NOD
    CHECK(read_file(directory / "in.msh").substr(0, format) == read_file(directory / "out.msh").substr(0, format));
  }
}

TEST_CASE("round trip: elements in no physical group are lost in no version") {
  for (const double version : {2.2, 4.1}) {
    CAPTURE(version);
    const TemporaryDirectory directory;
    // Before version 4, group 0 is how "no group" is written.
    make_msh(directory / "in.msh", version, false, [version] {
      build_two_squares();
      if (version < 4) {
        ::gmsh::model::addPhysicalGroup(2, {2}, 0);
        ::gmsh::model::addPhysicalGroup(1, {1, 2, 3, 5, 6, 7}, 0);
      }
    });
    const Snapshot before = read_snapshot(directory / "in.msh");
    REQUIRE(element_counts(before, 2).first > 0);
    REQUIRE(before.groups.size() == 4);
    CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).status == 0);
    CHECK(difference(before, read_snapshot(directory / "out.msh"), {1, 2}) == "");
  }
}

TEST_CASE("round trip: a surface that is not selected comes out as it went in") {
  for (const double version : {2.2, 4.1}) {
    const TemporaryDirectory directory;
    make_msh(directory / "in.msh", version, false, [] {
      build_two_squares();
      ::gmsh::model::removePhysicalGroups({});
    });
    const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--surfaces", "2"});
    CHECK(result.status == 0);
    const Snapshot before = read_snapshot(directory / "in.msh"), after = read_snapshot(directory / "out.msh");
    CHECK(difference(before, after, {2}) == "");
    CHECK(element_counts(after, 1) == element_counts(before, 1));
    CHECK(element_counts(after, 2).first == 0);
  }
}

TEST_CASE("round trip: sparse and large tags stay") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [] {
    const int surface = ::gmsh::model::addDiscreteEntity(2, 77);
    const Grid grid;
    std::vector<std::size_t> tags, elements, nodes;
    std::vector<double> xyz;
    for (const auto& p : grid.nodes()) {
      tags.push_back(1000000000 + 7919 * tags.size());
      xyz.insert(xyz.end(), p.begin(), p.end());
    }
    for (const auto& triangle : grid.triangles()) {
      elements.push_back(2000000000 + 13 * elements.size());
      for (int node : triangle) nodes.push_back(tags[node - 1]);
    }
    ::gmsh::model::mesh::addNodes(2, surface, tags, xyz);
    ::gmsh::model::mesh::addElements(2, surface, {2}, {elements}, {nodes});
  });
  CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).status == 0);
  const Snapshot before = read_snapshot(directory / "in.msh"), after = read_snapshot(directory / "out.msh");
  CHECK(difference(before, after, {77}) == "");  // with the tags of the nodes on the boundary
  CHECK(element_counts(after, 77).first == 0);
}

TEST_CASE("round trip: periodic curves stay periodic") {
  for (const double version : {2.2, 4.1}) {
    CAPTURE(version);
    const TemporaryDirectory directory;
    make_msh(directory / "in.msh", version, false, [] {
      build_periodic();
      ::gmsh::model::removePhysicalGroups({});
    });
    const auto before = periodic_pairs(directory / "in.msh");
    REQUIRE(before.size() > 4);
    CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).status == 0);
    CHECK(periodic_pairs(directory / "out.msh") == before);
  }
}

TEST_CASE("round trip: a partitioned mesh keeps its partitions") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [] {
    build_two_squares();
    ::gmsh::model::mesh::partition(3);
  });
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  const Snapshot before = read_snapshot(directory / "in.msh"), after = read_snapshot(directory / "out.msh");
  std::set<int> surfaces;
  for (const auto& entity : before.mesh.entities)
    if (entity.dim == 2) surfaces.insert(entity.tag);
  CHECK(difference(before, after, surfaces) == "");
  const std::string in = read_file(directory / "in.msh"), out = read_file(directory / "out.msh");
  const auto partitions = [](const std::string& text) {
    const std::size_t begin = text.find("$PartitionedEntities"), end = text.find("$EndPartitionedEntities");
    return text.substr(begin, end - begin);
  };
  CHECK(partitions(in).size() > 20);
  CHECK(partitions(in) == partitions(out));
}

TEST_CASE("round trip: tags of surfaces and curves that are partitioned mean their parts") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [] {
    build_two_squares();
    ::gmsh::model::mesh::partition(3);
  });
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {directory / "in.msh", "-o", directory / "out.msh"};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = run_qmorph(words);
    CAPTURE(result.err);
    CHECK(result.status == 0);
    return read_snapshot(directory / "out.msh");
  };
  std::size_t left = 0;
  for (const auto& entity : run({"--surfaces", "1"}).mesh.entities)
    if (entity.dim == 2 && entity.element_count()) {
      const bool is_left = entity.xyz.empty() || entity.xyz[0] < 1;
      CHECK((entity.polygons(4) != nullptr) == is_left);
      left += is_left;
    }
  CHECK(left > 0);

  const auto outer_lines = [](const Snapshot& snapshot) {  // on the parts of curve 4, where x = 0
    std::size_t lines = 0;
    for (const auto& entity : snapshot.mesh.entities)
      for (const auto& block : entity.blocks)
        for (std::size_t i = 0; entity.dim == 1 && i + 1 < block.nodes.size(); i += 2)
          lines += snapshot.mesh.points[snapshot.mesh.rows.find(block.nodes[i])].x() == 0 &&
                   snapshot.mesh.points[snapshot.mesh.rows.find(block.nodes[i + 1])].x() == 0;
    return lines;
  };
  CHECK(outer_lines(run({"--all-quad", "--keep-curves", "4"})) == outer_lines(read_snapshot(directory / "in.msh")));
}

TEST_CASE("round trip: a partitioned mesh of MSH 2.2 keeps its partitions") {
  for (const bool binary : {false, true}) {
    CAPTURE(binary);
    const TemporaryDirectory directory;
    make_msh(directory / "in.msh", 2.2, binary, [] {
      build_two_squares();
      ::gmsh::model::removePhysicalGroups({});
      ::gmsh::model::mesh::partition(3);
    });
    CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).status == 0);
    const auto partitions = [&](const std::string& name) {
      const qmorph::adapter::Session session;
      qmorph::adapter::run_logged([&] { ::gmsh::open(directory / name); });
      std::set<std::vector<int>> found;
      ::gmsh::vectorpair entities;
      ::gmsh::model::getEntities(entities);
      for (const auto& [dim, tag] : entities) {
        std::vector<int> numbers;
        ::gmsh::model::getPartitions(dim, tag, numbers);
        if (dim == 2) found.insert(numbers);
      }
      return found;
    };
    CHECK(partitions("in.msh").size() == 4);  // three, and the surfaces that they are parts of
    CHECK(partitions("in.msh") == partitions("out.msh"));
  }
}

TEST_CASE("round trip: quads that are there already stay, with their tags") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [] {
    build_two_squares();
    ::gmsh::model::mesh::clear();
    ::gmsh::model::mesh::setTransfiniteSurface(2);
    ::gmsh::model::mesh::setRecombine(2, 2);
    ::gmsh::model::mesh::generate(2);
  });
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(result.status == 0);
  CHECK(result.err.find("surface 2: ") != std::string::npos);
  CHECK(result.err.find("quads already") != std::string::npos);
  CHECK(difference(read_snapshot(directory / "in.msh"), read_snapshot(directory / "out.msh"), {1}) == "");
}

TEST_CASE("round trip: the same input gives the same bytes") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  run_qmorph({directory / "in.msh", "-o", directory / "a.msh"});
  run_qmorph({directory / "in.msh", "-o", directory / "b.msh", "-nt", "4"});
  CHECK((read_file(directory / "a.msh") == read_file(directory / "b.msh")));
}

TEST_CASE("round trip: -o may be the input") {
  const TemporaryDirectory directory;
  make_msh(directory / "mesh.msh", 4.1, false, build_two_squares);
  const Snapshot before = read_snapshot(directory / "mesh.msh");
  CHECK(run_qmorph({directory / "mesh.msh"}).status == 0);  // Gmsh's rule for the name gives the input's
  CHECK(directory.files() == std::vector<std::string>{"mesh.msh"});
  CHECK(difference(before, read_snapshot(directory / "mesh.msh"), {1, 2}) == "");
}

TEST_CASE("round trip: a mesh of quads comes through byte for byte, with status 0") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  REQUIRE(run_qmorph({directory / "in.msh", "-o", directory / "quads.msh"}).status == 0);
  const Result result = run_qmorph({directory / "quads.msh", "-o", directory / "again.msh"});
  CHECK(result.status == 0);  // a pipeline goes on
  CHECK(result.err.find("nothing to convert") != std::string::npos);
  CHECK((read_file(directory / "again.msh") == read_file(directory / "quads.msh")));
}
