// SPDX-License-Identifier: GPL-2.0-or-later
/// Files are what readers of their formats accept: the same bytes each time, with elements and nodes that they know; or
/// none at all.

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/element_types.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Three strips side by side; the loop of the middle one runs clockwise. In the x-y plane, or turned out of it.
std::string strips(bool tilted = false) {
  std::string text = "SetFactory(\"Built-in\");\nh = 0.3;\n";
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 2; ++j)
      text += "Point(" + std::to_string(10 + 10 * j + i) + ") = {" + std::to_string(i) + "," + std::to_string(j) + "," +
              (tilted ? std::to_string(-j) : "0") + ",h};\n";
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j)
      text += "Line(" + std::to_string(10 + 10 * j + i) + ") = {" + std::to_string(10 + 10 * j + i) + "," +
              std::to_string(11 + 10 * j + i) + "};\n";
  for (int i = 0; i < 4; ++i)
    text += "Line(" + std::to_string(30 + i) + ") = {" + std::to_string(10 + i) + "," + std::to_string(20 + i) + "};\n";
  return text +
         "Curve Loop(1) = {10,31,-20,-30}; Plane Surface(1) = {1};\nCurve Loop(2) = {-11,31,21,-32}; Plane Surface(2) "
         "= {2};\n"
         "Curve Loop(3) = {12,33,-22,-32}; Plane Surface(3) = {3};\nPhysical Surface(\"all\", 1) = {1:3};\n"
         "Physical Curve(\"left\", 2) = {30};\n";
}

constexpr const char* kPeriodic =
    "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\nPeriodic Curve {3} = {1} Translate {0, 1, 0};\n"
    "Mesh.MeshSizeMax = 0.3;\n";

constexpr const char* kDisk =
    "SetFactory(\"OpenCASCADE\");\nDisk(1) = {0, 0, 0, 1};\nMesh.MeshSizeMax = 0.4;\nPhysical Surface(\"disk\", 3) = "
    "{1};\n"
    "Physical Curve(\"rim\", 4) = {1};\n";

/// How often edges of surface elements are run along in one direction twice.
std::size_t count_disagreements(const Snapshot& snapshot) {
  std::map<std::pair<std::size_t, std::size_t>, int> runs;
  for (const auto& entity : snapshot.mesh.entities)
    for (const auto& block : entity.blocks)
      for (std::size_t i = 0; entity.dim == 2 && i < block.nodes.size(); i += block.nodes_per_element)
        for (std::size_t k = 0; k < block.corners; ++k)
          ++runs[{block.nodes[i + k], block.nodes[i + (k + 1) % block.corners]}];
  return std::size_t(std::count_if(runs.begin(), runs.end(), [](const auto& run) { return run.second > 1; }));
}

/// Twice the area of all surface elements, as a vector.
Eigen::Vector3d area(const Snapshot& snapshot) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto point = [&](std::size_t tag) { return snapshot.mesh.points[snapshot.mesh.rows.find(tag)]; };
  for (const auto& entity : snapshot.mesh.entities)
    for (const auto& block : entity.blocks)
      for (std::size_t i = 0; entity.dim == 2 && i < block.nodes.size(); i += block.nodes_per_element)
        for (std::size_t k = 2; k < block.corners; ++k)
          sum += (point(block.nodes[i + k - 1]) - point(block.nodes[i]))
                     .cross(point(block.nodes[i + k]) - point(block.nodes[i]));
  return sum;
}

std::set<int> types_of(const Snapshot& snapshot, int dim) {
  std::set<int> types;
  for (const auto& entity : snapshot.mesh.entities)
    for (const auto& block : entity.blocks)
      if (entity.dim == dim) types.insert(block.type);
  return types;
}

}  // namespace

TEST_CASE("readers: MFEM is told which nodes are images of others") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kPeriodic);
  REQUIRE(run_qmorph({directory / "in.geo", "-o", directory / "out.msh", "--for", "mfem"}).status == 0);
  const std::string text = read_file(directory / "out.msh");
  REQUIRE(mentions(text, "$Periodic\n"));
  const Snapshot snapshot = read_snapshot(directory / "out.msh");
  std::istringstream in(text.substr(text.find("$Periodic\n") + 10));
  int links = 0;
  std::size_t pairs = 0;
  in >> links;
  CHECK(links == 3);  // the curve and its ends
  for (int i = 0; i < links; ++i) {
    int dim = 0, slave = 0, master = 0;
    std::string word;
    std::size_t count = 0;
    in >> dim >> slave >> master >> word;
    if (word == "Affine") {
      for (int k = 0; k < 16; ++k) in >> word;
      in >> count;
    } else {
      count = std::stoul(word);
    }
    for (std::size_t k = 0; k < count; ++k, ++pairs) {
      std::size_t a = 0, b = 0;
      in >> a >> b;
      REQUIRE(snapshot.mesh.rows.find(a) != kNone);
      REQUIRE(snapshot.mesh.rows.find(b) != kNone);
      const Eigen::Vector3d step =
          snapshot.mesh.points[snapshot.mesh.rows.find(a)] - snapshot.mesh.points[snapshot.mesh.rows.find(b)];
      CHECK((step - Eigen::Vector3d(0, 1, 0)).norm() < 1e-9);
    }
  }
  CHECK(pairs > 4);
  REQUIRE(run_qmorph({directory / "in.geo", "-o", directory / "elmer.msh", "--for", "elmer"}).status == 0);
  CHECK(!mentions(read_file(directory / "elmer.msh"), "$Periodic"));
}

TEST_CASE("readers: quads of order 2 in UNV are parabolic shells of 8 nodes") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kDisk);
  REQUIRE(run_qmorph({directory / "in.geo", "-order", "2", "-o", directory / "nine.msh"}).status == 0);
  for (const char* input : {"in.geo", "nine.msh"}) {
    CAPTURE(std::string(input));
    REQUIRE(run_qmorph({directory / input, "-order", "2", "-o", directory / "out.unv"}).status == 0);
    const Snapshot snapshot = read_snapshot(directory / "out.unv");
    CHECK(types_of(snapshot, 2) == std::set<int>{16});
    for (const auto& entity : snapshot.mesh.entities)  // nodes between those of the rim lie on the circle
      for (const auto& block : entity.blocks)
        for (std::size_t node : entity.dim == 1 ? block.nodes : std::vector<std::size_t>())
          CHECK(snapshot.mesh.points[snapshot.mesh.rows.find(node)].norm() == doctest::Approx(1).epsilon(1e-6));
  }
  for (const char* name : {"out.inp", "out.key"}) {
    CAPTURE(std::string(name));
    REQUIRE(run_qmorph({directory / "nine.msh", "-o", directory / name}).status == 0);
    CHECK(!mentions(read_file(directory / name), "M3D9"));
  }
  CHECK(mentions(read_file(directory / "out.inp"), "type=CPS8"));
  CHECK(run_qmorph({directory / "nine.msh", "-o", directory / "calculix.inp", "--for", "calculix"}).status == 0);
  CHECK(mentions(read_file(directory / "calculix.inp"), "TYPE=CPS8"));
}

TEST_CASE("readers: quads of order 2 in .mesh go by the name of that order") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kDisk);
  REQUIRE(run_qmorph({directory / "in.geo", "-order", "2", "-o", directory / "nine.msh"}).status == 0);
  for (const char* input : {"in.geo", "nine.msh"}) {
    CAPTURE(std::string(input));
    REQUIRE(run_qmorph({directory / input, "-order", "2", "-o", directory / "out.mesh"}).status == 0);
    const std::string text = read_file(directory / "out.mesh");
    CHECK(mentions(text, "\n EdgesP2\n"));
    REQUIRE(mentions(text, "\n QuadrilateralsQ2\n"));
    std::istringstream in(text.substr(text.find(" QuadrilateralsQ2\n")));
    std::string line;
    std::getline(in, line), std::getline(in, line), std::getline(in, line);
    std::istringstream words(line);
    CHECK(std::distance(std::istream_iterator<std::string>(words), {}) == 10);  // nine nodes and a tag
  }
  write_file(directory / "eight.geo", std::string(kDisk) + "Mesh.SecondOrderIncomplete = 1;\n");
  REQUIRE(run_qmorph({directory / "eight.geo", "-order", "2", "-o", directory / "eight.msh"}).status == 0);
  const Result refused = run_qmorph({directory / "eight.msh", "-o", directory / "eight.mesh"});
  CHECK(refused.status == 5);
  CHECK(mentions(refused.err, "has quads with 9 nodes for order 2, and the mesh has some with 8"));
  CHECK_FALSE(std::filesystem::exists(directory / "eight.mesh"));
}

TEST_CASE("readers: every format is written completely, or refused before anything is written") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", strips());
  // Numbers with gaps, a node that nothing uses, surfaces in no group.
  write_file(directory / "gaps.msh",
             "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n3 0 0 0\n70 1 0 0\n700 1 1 0\n9000 0 1 0\n9500 5 5 0\n"
             "$EndNodes\n$Elements\n2\n10 2 2 0 1 3 70 700\n90 2 2 0 1 3 700 9000\n$EndElements\n");
  const std::vector<std::string> formats = {"msh", "msh1", "msh2", "msh22", "msh3", "msh4", "msh40", "msh41",
                                            "unv", "vtk",  "mail", "mesh",  "bdf",  "cgns", "med",   "diff",
                                            "ir3", "inp",  "su2",  "dat",   "m",    "key",  "off",   "obj",
                                            "stl", "ply2", "p3d",  "celum", "neu",  "wrl",  "x3d"};
  for (const std::string& input : {std::string("in.geo"), std::string("gaps.msh")})
    for (const std::string& format : formats)
      for (const char* order : {"1", "2", "3"}) {
        CAPTURE(input);
        CAPTURE(format);
        CAPTURE(std::string(order));
        const std::string out = directory / ("out." + format);
        const Result result = run_qmorph({directory / input, "-order", order, "-o", out});
        CAPTURE(result.err);
        CHECK((result.status == 0 || result.status == 5));
        CHECK(std::filesystem::exists(out) == (result.status == 0));
        if (result.status == 5) CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
        std::filesystem::remove(out);
        CHECK(directory.files() == std::vector<std::string>{"gaps.msh", "in.geo"});
      }
  CHECK(run_qmorph({directory / "in.geo", "-o", directory / "out.diff"}).status == 0);
  CHECK(run_qmorph({directory / "gaps.msh", "-o", directory / "gaps.diff"}).status == 0);
  CHECK(mentions(read_file(directory / "gaps.diff"), "Number of nodes      =  4\n"));
  CHECK(run_qmorph({directory / "in.geo", "-o", directory / "out.mail"}).status == 5);  // it would have no quad
}

TEST_CASE("readers: --orient orients neighbours alike, in the plane and in space, in every format that records it") {
  const TemporaryDirectory directory;
  write_file(directory / "flat.geo", strips());
  write_file(directory / "tilted.geo", strips(true));
  REQUIRE(run_qmorph({directory / "flat.geo", "-o", directory / "as_it_is.msh"}).status == 0);
  REQUIRE(count_disagreements(read_snapshot(directory / "as_it_is.msh")) > 0);
  for (const char* name : {"out.msh", "out.vtk", "out.unv"}) {
    CAPTURE(std::string(name));
    REQUIRE(run_qmorph({directory / "flat.geo", "--orient", "-o", directory / name}).status == 0);
    const Snapshot snapshot = read_snapshot(directory / name);
    CHECK(count_disagreements(snapshot) == 0);
    CHECK(area(snapshot).z() == doctest::Approx(6));
  }
  for (const char* order : {"1", "2"}) {
    REQUIRE(run_qmorph({directory / "tilted.geo", "--orient", "-order", order, "-o", directory / "out.msh"}).status ==
            0);
    const Snapshot tilted = read_snapshot(directory / "out.msh");
    CHECK(count_disagreements(tilted) == 0);
    CHECK(area(tilted).norm() == doctest::Approx(2 * 3 * std::sqrt(2)));
  }
  REQUIRE(run_qmorph({directory / "as_it_is.msh", "-o", directory / "again.msh", "--orient"}).status == 0);
  CHECK(count_disagreements(read_snapshot(directory / "again.msh")) == 0);
  const Result reader = run_qmorph({directory / "flat.geo", "--for", "dealii", "-o", directory / "dealii.msh"});
  CHECK(reader.status == 0);
  CHECK(count_disagreements(read_snapshot(directory / "dealii.msh")) == 0);
}

TEST_CASE("readers: a strip that cannot be oriented is reported") {
  const TemporaryDirectory directory;
  // Eight quads around a circle, with half a turn.
  std::vector<std::array<double, 3>> nodes;
  std::vector<std::string> quads;
  const int n = 8;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * M_PI * i / n, turn = angle / 2;
    for (const double side : {-0.5, 0.5}) {
      const double radius = 2 + side * std::cos(turn);
      nodes.push_back({radius * std::cos(angle), radius * std::sin(angle), side * std::sin(turn)});
    }
    const int a = 2 * i + 1, b = a + 1, c = i + 1 < n ? a + 2 : 2, d = i + 1 < n ? a + 3 : 1;
    quads.push_back(row<4>("3 2 0 1", {a, b, d, c}));
  }
  write_file(directory / "in.msh", msh22(nodes, quads));
  const Result result = run_qmorph({directory / "in.msh", "--orient", "-o", directory / "out.msh"});
  CHECK(mentions(result.err, "no orientation, like a Moebius strip"));
}

TEST_CASE("readers: a point that belongs to nothing is left out for readers") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo",
             strips() + "Point(99) = {1.234, 0.5, 0, 0.1};\nPhysical Point(\"loose\", 9) = {99};\n");
  for (const char* reader : {"dealii", "mfem", "dolfinx", "elmer", "su2"}) {
    CAPTURE(std::string(reader));
    REQUIRE(run_qmorph({directory / "in.geo", "--for", reader, "-o", directory / "out"}).status == 0);
    CHECK(!mentions(read_file(directory / "out"), "1.234"));
  }
  REQUIRE(run_qmorph({directory / "in.geo", "-save_all", "-o", directory / "out.su2"}).status == 0);
  CHECK(!mentions(read_file(directory / "out.su2"), "1.234"));
  // In a deck it may be what others are tied to.
  REQUIRE(run_qmorph({directory / "in.geo", "--for", "calculix", "-o", directory / "out.inp"}).status == 0);
  CHECK(mentions(read_file(directory / "out.inp"), "NSET=loose"));
}
