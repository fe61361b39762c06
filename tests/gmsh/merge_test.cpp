// SPDX-License-Identifier: GPL-2.0-or-later
/// Several files make one model.

#include "gmsh/read/merge.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "gmsh/convert/periodic.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

/// A unit square with its lower left corner at (x, 0): surface 1 in one group, and its outline in "wall" (6).
std::function<void()> square_at(double x, const std::string& name, int group, int first_number = 1) {
  return [=] {
    ::gmsh::model::occ::addRectangle(x, 0, 0, 1, 1, 1);
    ::gmsh::model::occ::synchronize();
    ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.3);
    ::gmsh::model::addPhysicalGroup(2, {1}, group);
    ::gmsh::model::setPhysicalName(2, group, name);
    ::gmsh::model::addPhysicalGroup(1, {1, 2, 3, 4}, 6);
    ::gmsh::model::setPhysicalName(1, 6, "wall");
    ::gmsh::option::setNumber("Mesh.FirstNodeTag", first_number);
    ::gmsh::option::setNumber("Mesh.FirstElementTag", first_number);
    ::gmsh::model::mesh::generate(2);
  };
}

double area_of_group(const Snapshot& snapshot, int group) {
  double area = 0;
  for (int surface : snapshot.groups.at({2, group}).second)
    for (const auto& entity : snapshot.mesh.entities)
      for (const auto& block : entity.blocks)
        for (std::size_t i = 0; entity.dim == 2 && entity.tag == surface && i < block.nodes.size();
             i += block.nodes_per_element)
          for (std::size_t k = 0; k < block.nodes_per_element; ++k) {
            const auto& p = snapshot.mesh.points[snapshot.mesh.rows.find(block.nodes[i + k])];
            const auto& q =
                snapshot.mesh.points[snapshot.mesh.rows.find(block.nodes[i + (k + 1) % block.nodes_per_element])];
            area += (p.x() * q.y() - q.x() * p.y()) / 2;
          }
  return area;
}

}  // namespace

TEST_CASE("merge: files with the same numbers lie side by side, each with its groups") {
  for (double version : {2.2, 4.1})
    for (bool binary : {false, true}) {
      CAPTURE(version);
      CAPTURE(binary);
      const TemporaryDirectory directory;
      make_msh(directory / "a.msh", version, binary, square_at(0, "left", 5));
      make_msh(directory / "b.msh", version, binary, square_at(1, "right", 7));
      const Result result = run_qmorph({directory / "a.msh", directory / "b.msh", "-o", directory / "out.msh"});
      CHECK(result.status == 0);
      const Snapshot out = read_snapshot(directory / "out.msh");
      REQUIRE(out.groups.count({2, 5}) == 1);
      REQUIRE(out.groups.count({2, 7}) == 1);
      CHECK(out.groups.at({2, 5}).first == "left");
      CHECK(out.groups.at({2, 7}).first == "right");
      CHECK(area_of_group(out, 5) == doctest::Approx(1));
      CHECK(area_of_group(out, 7) == doctest::Approx(1));
      CHECK(out.groups.at({1, 6}).first == "wall");
      CHECK(out.groups.at({1, 6}).second.size() == 8);
    }
}

TEST_CASE(
    "merge: surfaces with one number in different groups stay apart though their nodes have numbers of their own") {
  const TemporaryDirectory directory;
  make_msh(directory / "a.msh", 4.1, false, square_at(0, "left", 5));
  make_msh(directory / "b.msh", 4.1, false, square_at(1, "right", 7, 1000));
  CHECK(run_qmorph({directory / "a.msh", directory / "b.msh", "-o", directory / "out.msh"}).status == 0);
  const Snapshot out = read_snapshot(directory / "out.msh");
  CHECK(area_of_group(out, 5) == doctest::Approx(1));
  CHECK(area_of_group(out, 7) == doctest::Approx(1));
}

TEST_CASE("merge: a file given twice counts once, and one that adds a surface to the nodes of another joins it") {
  const TemporaryDirectory directory;
  make_msh(directory / "a.msh", 4.1, false, square_at(0, "left", 5));
  CHECK(run_qmorph({directory / "a.msh", directory / "a.msh", "-o", directory / "twice.msh"}).status == 0);
  const Snapshot a = read_snapshot(directory / "a.msh"), twice = read_snapshot(directory / "twice.msh");
  CHECK(difference(a, twice, {1}) == "");

  const Grid grid;
  std::vector<std::string> lower, upper;
  for (const auto& triangle : grid.triangles()) (lower.size() < 16 ? lower : upper).push_back(row("2 2 1 1", triangle));
  for (std::string& text : upper) text.replace(0, 7, "2 2 2 2");
  write_file(directory / "lower.msh", msh22(grid.nodes(), lower));
  std::vector<std::string> both = lower;
  both.insert(both.end(), upper.begin(), upper.end());
  write_file(directory / "both.msh", msh22(grid.nodes(), both));
  CHECK(run_qmorph({directory / "lower.msh", directory / "both.msh", "-o", directory / "joined.msh"}).status == 0);
  const Snapshot joined = read_snapshot(directory / "joined.msh");
  CHECK(joined.mesh.tags.size() == 25);
  CHECK(element_counts(joined, 1) == std::pair<std::size_t, std::size_t>(0, 8));
  CHECK(element_counts(joined, 2) == std::pair<std::size_t, std::size_t>(0, 8));
}

TEST_CASE("merge: periodic links of the second file are kept") {
  const auto build = [](double x) {
    return [x] {
      ::gmsh::model::occ::addRectangle(x, 0, 0, 1, 1, 1);
      ::gmsh::model::occ::synchronize();
      ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.3);
      ::gmsh::model::mesh::setPeriodic(1, {2}, {4}, {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
      ::gmsh::model::mesh::generate(2);
    };
  };
  const TemporaryDirectory directory;
  make_msh(directory / "a.msh", 4.1, false, build(0));
  make_msh(directory / "b.msh", 4.1, false, build(3));
  CHECK(run_qmorph({directory / "a.msh", directory / "b.msh", "-o", directory / "out.msh"}).status == 0);
  const adapter::Session session;
  adapter::set_option("Mesh.IgnorePeriodicity", 0);
  adapter::run_logged([&] { ::gmsh::open(directory / "out.msh"); });
  const adapter::ModelMesh mesh = adapter::read_model_mesh();
  const auto links = adapter::read_periodic_links(mesh, 1);
  REQUIRE(links.size() == 2);
  CHECK(links[0].nodes.size() == links[1].nodes.size());
  for (const auto& [slave, master] : links[1].nodes) {
    const auto &p = mesh.points[mesh.rows.find(slave)], &q = mesh.points[mesh.rows.find(master)];
    CHECK(p.x() == doctest::Approx(q.x() + 1));
    CHECK(q.x() == doctest::Approx(3));
  }
}

TEST_CASE("merge: a file of data alone goes onto the mesh of the first") {
  const TemporaryDirectory directory;
  make_msh(directory / "a.msh", 4.1, false, square_at(0, "left", 5));
  std::string data = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$NodeData\n1\n\"height\"\n1\n0\n3\n0\n1\n";
  const Snapshot a = read_snapshot(directory / "a.msh");
  data += std::to_string(a.mesh.tags.size()) + '\n';
  for (std::size_t i = 0; i < a.mesh.tags.size(); ++i)
    data += std::to_string(a.mesh.tags[i]) + ' ' + std::to_string(a.mesh.points[i].y()) + '\n';
  write_file(directory / "data.msh", data + "$EndNodeData\n");
  CHECK(run_qmorph({directory / "a.msh", directory / "data.msh", "-o", directory / "out.msh"}).status == 0);
  CHECK(read_file(directory / "out.msh").find("$NodeData\n1\n\"height\"") != std::string::npos);
}

TEST_CASE("merge: a geometry whose entities a foreign mesh would take over, or the other way round, is refused") {
  const TemporaryDirectory directory;
  const std::string head = "SetFactory(\"OpenCASCADE\");\nMesh.MeshSizeMax = 0.3;\n";
  write_file(directory / "same.geo", head + "Rectangle(1) = {5, 0, 0, 1, 1};\n");
  write_file(directory / "other.geo", head + "Rectangle(9) = {5, 0, 0, 1, 1};\n");
  write_file(directory / "plain.geo",
             "Point(1) = {5,0,0,.3}; Point(2) = {6,0,0,.3}; Point(3) = {5,1,0,.3};\n"
             "Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,1}; Curve Loop(1) = {1:3}; Plane Surface(1) = {1};\n");
  for (double version : {2.2, 4.1}) {
    make_msh(directory / "b.msh", version, false, square_at(0, "left", 5));
    for (const char* name : {"same.geo", "other.geo", "plain.geo"})
      for (bool geometry_first : {true, false}) {
        if (name == std::string("other.geo") && !geometry_first) continue;  // it gets other numbers
        CAPTURE(name);
        CAPTURE(geometry_first);
        const std::string first = geometry_first ? name : "b.msh", second = geometry_first ? "b.msh" : name;
        const Result result = run_qmorph({directory / first, directory / second, "-o", directory / "out.msh"});
        CAPTURE(result.err);
        CHECK(result.status == 2);
        CHECK(result.err.find("mesh the geometry to a .msh file first") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(directory / "out.msh"));
      }
  }
}

TEST_CASE("merge: a mesh beside a geometry stays, and the geometry is meshed") {
  const TemporaryDirectory directory;
  write_file(directory / "cad.geo",
             "SetFactory(\"OpenCASCADE\");\nMesh.MeshSizeMax = 0.3;\nRectangle(9) = {5, 0, 0, 1, 1};\n");
  write_file(directory / "both.geo", "Merge \"part.msh\";\nMerge \"cad.geo\";\n");
  for (double version : {2.2, 4.1}) {
    CAPTURE(version);
    make_msh(directory / "part.msh", version, false, square_at(0, "left", 5));
    const Snapshot part = read_snapshot(directory / "part.msh");
    std::vector<std::string> all = {"-setnumber", "Mesh.SaveAll", "1", "-o", directory / "out.msh"};
    std::vector<std::string> script = {directory / "both.geo"}, files = {directory / "part.msh", directory / "cad.geo"};
    for (std::vector<std::string> words : {script, files}) {
      words.insert(words.end(), all.begin(), all.end());
      const Result result = run_qmorph(words);
      CAPTURE(result.err);
      CHECK(result.status == 0);
      const Snapshot after = read_snapshot(directory / "out.msh");
      CHECK(element_counts(after, 1).first == 0);
      CHECK(element_counts(after, 1).second == element_counts(part, 1).first / 162 * 64);
      CHECK(element_counts(after, 9) == std::pair<std::size_t, std::size_t>(0, 16));
    }
  }
}

TEST_CASE("merge: a geometry takes its own mesh, and a mesh takes a script") {
  const TemporaryDirectory directory;
  write_file(directory / "a.geo",
             "SetFactory(\"OpenCASCADE\");\nMesh.MeshSizeMax = 0.3;\nDisk(1) = {0, 0, 0, 1};\n"
             "Rectangle(2) = {3, 0, 0, 1, 1};\n");
  write_file(directory / "script.geo", "Physical Surface(\"all\", 8) = {1, 2};\n");
  make_msh(directory / "a.msh", 4.1, false, [&] {
    ::gmsh::merge(directory / "a.geo");
    ::gmsh::model::mesh::generate(2);
  });
  for (const auto& files : {std::pair("a.geo", "a.msh"), std::pair("a.msh", "script.geo")}) {
    CAPTURE(files.first);
    const Result result = run_qmorph({directory / files.first, directory / files.second, "-o", directory / "out.msh"});
    CAPTURE(result.err);
    CHECK(result.status == 0);
    for (int surface : {1, 2}) CHECK(element_counts(read_snapshot(directory / "out.msh"), surface).second > 0);
  }
}
