// SPDX-License-Identifier: GPL-2.0-or-later
/// Layers as Gmsh makes them, with the quads that it makes itself as the truth.

#include <doctest/doctest.h>
#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "gmsh/support.hpp"

using namespace qmorph::test;

namespace {

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A block in a box, with fans of quads at its corners. Layers of `first` height with `Quads = quads`.
std::string block_in_box(const std::string& first, const std::string& ratio, bool quads) {
  return "Point(1)={0,0,0,.1}; Point(2)={1,0,0,.1}; Point(3)={1,.4,0,.1}; Point(4)={0,.4,0,.1};\n"
         "Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1};\n"
         "Point(5)={-1,-1,0,.4}; Point(6)={2,-1,0,.4}; Point(7)={2,1.4,0,.4}; Point(8)={-1,1.4,0,.4};\n"
         "Line(5)={5,6}; Line(6)={6,7}; Line(7)={7,8}; Line(8)={8,5};\n"
         "Curve Loop(1)={5:8}; Curve Loop(2)={1:4}; Plane Surface(1)={1,2};\n"
         "Field[1]=BoundaryLayer; Field[1].EdgesList={1:4}; Field[1].FanNodesList={1:4}; Field[1].hwall_n=" +
         first + "; Field[1].ratio=" + ratio +
         "; Field[1].thickness=.08; Field[1].hfar=.4; Field[1].Quads=" + (quads ? "1" : "0") +
         ";\nBoundaryLayer Field=1; Physical Curve(\"wall\")={1:4}; Physical Surface(\"fluid\")={1};\n";
}

/// The same with quads, and fans of so many elements at two corners.
std::string block_with_fans(int elements) {
  const std::string size = std::to_string(elements);
  std::string script = block_in_box(".01", "1.3", true);
  const std::string all = "Field[1].FanNodesList={1:4};";
  return script.replace(script.find(all), all.size(),
                        "Field[1].FanPointsList={1,2}; Field[1].FanPointsSizesList={" + size + "," + size + "};");
}

/// A wall that was extruded in layers; recombined or not.
std::string extruded_wall(bool quads) {
  return std::string("Point(1)={0,0,0,.1}; Point(2)={2,0,0,.1}; Line(1)={1,2}; Transfinite Curve{1}=21;\n") +
         "e[]=Extrude{0,.1,0}{ Curve{1}; Layers{ {1,1,1,1}, {.05,.2,.5,1} };" + (quads ? " Recombine;" : "") + " };\n";
}

/// A quarter of a cylinder with rows from one rim to the other.
std::string extruded_arc(bool quads) {
  return std::string(
             "Point(1)={0,0,0}; Point(2)={1,0,0}; Point(3)={0,1,0}; Circle(1)={2,1,3}; Transfinite Curve{1}=21;\n") +
         "e[]=Extrude{0,0,1}{ Curve{1}; Layers{ {1,1,1,1,1,8}, {.01,.03,.07,.14,.24,1} };" +
         (quads ? " Recombine;" : "") + " };\n";
}

std::string transfinite(bool quads) {
  return std::string("Point(1)={0,0,0}; Point(2)={2,0,0}; Point(3)={2.2,1,0}; Point(4)={0,1,0};\n") +
         "Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1}; Curve Loop(1)={1:4}; Plane Surface(1)={1};\n"
         "Transfinite Curve{1,-3}=31 Using Bump .05; Transfinite Curve{2,-4}=25 Using Progression 1.3;\n"
         "Transfinite Surface{1} Alternated;\n" +
         (quads ? "Recombine Surface{1};\n" : "");
}

using Place = std::array<long long, 3>;  // rounded, since files are
using Places = std::array<Place, 4>;

/// The quads of a file by their corners' places. \param mesh_first by Gmsh, as the script says
std::set<Places> quads_of(const std::string& path, bool mesh_first) {
  const RunningGmsh running;
  gmsh::option::setNumber("General.Verbosity", 0);
  gmsh::open(path);
  if (mesh_first) gmsh::model::mesh::generate(2);
  std::vector<std::size_t> tags, nodes, node_tags;
  std::vector<double> xyz, uv;
  gmsh::model::mesh::getNodes(node_tags, xyz, uv);
  std::map<std::size_t, Place> place;
  for (std::size_t i = 0; i < xyz.size(); ++i) place[node_tags[i / 3]][i % 3] = std::llround(1e9 * xyz[i]);
  gmsh::model::mesh::getElementsByType(3, tags, nodes);
  std::set<Places> quads;
  for (std::size_t e = 0; e < tags.size(); ++e) {
    Places corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = place[nodes[4 * e + k]];
    std::sort(corners.begin(), corners.end());
    quads.insert(corners);
  }
  return quads;
}

std::size_t lost(const std::set<Places>& truth, const std::set<Places>& quads) {
  std::size_t count = 0;
  for (const Places& quad : truth) count += !quads.contains(quad);
  return count;
}

/// What --stats says, without a JSON reader: the number behind a name.
double figure(const std::string& json, const std::string& name) {
  const std::size_t at = json.find('"' + name + "\":");
  REQUIRE(at != std::string::npos);
  return std::stod(json.substr(at + name.size() + 3));
}

}  // namespace

TEST_CASE("layers of Gmsh: triangles of a layer become the quads that Gmsh makes itself") {
  const TemporaryDirectory directory;
  const std::pair<std::string, std::string> cases[] = {
      {block_in_box(".005", "1.3", false), block_in_box(".005", "1.3", true)},
      {block_in_box(".0001", "1.4", false), block_in_box(".0001", "1.4", true)},
      {extruded_wall(false), extruded_wall(true)},
      {extruded_arc(false), extruded_arc(true)},
      {transfinite(false), transfinite(true)}};
  for (const auto& the_case : cases) {
    const auto& [script, with_quads] = the_case;
    write_file(directory / "in.geo", script);
    write_file(directory / "quads.geo", with_quads);
    write_file(directory / "triangles.geo", script);
    CAPTURE(the_case.first);
    // From the same triangles: from a geometry, curves would get an even number of segments first.
    {
      const RunningGmsh running;
      gmsh::option::setNumber("General.Verbosity", 0);
      gmsh::open(directory / "in.geo");
      gmsh::model::mesh::generate(2);
      gmsh::write(directory / "in.msh");
    }
    const Result result =
        run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--stats", directory / "out.json"});
    CAPTURE(result.err);
    CHECK(result.status == 0);
    const std::set<Places> truth = quads_of(directory / "quads.geo", true),
                           ours = quads_of(directory / "out.msh", false);
    REQUIRE(!truth.empty());
    const double kept = figure(read_file(directory / "out.json"), "layer_quads");
    CHECK(double(lost(truth, ours)) <= 0.02 * double(truth.size()));
    constexpr double kTips = 4 * 2;  // pairs of triangles at the corners
    CHECK(kept <= 1.01 * double(truth.size()) + kTips);
    CHECK(mentions(result.err, " of them in layers"));
    CHECK(!mentions(result.err, "warning"));
  }
}

TEST_CASE("layers of Gmsh: even where its own quads would enclose an odd fan, no triangle is left") {
  const TemporaryDirectory directory;
  for (const int fan : {3, 5}) {
    CAPTURE(fan);
    write_file(directory / "fan.geo", block_with_fans(fan));
    const std::string in = directory / "fan.geo", out = directory / "out.msh";
    const Result result = run_qmorph({in, "-o", out});
    CAPTURE(result.err);
    CHECK(result.status == 0);
    CHECK(element_counts(read_snapshot(out), 1).first == 0);
    // Only then are the layers made of triangles first.
    CHECK(mentions(result.err, " of them in layers") == (fan == 3));
    // Without rows from triangles the quads are Gmsh's: the fans stay odd, and nothing else is promised.
    const Result without = run_qmorph({in, "-o", out, "--layers=off"});
    CAPTURE(without.err);
    CHECK(element_counts(read_snapshot(out), 1).first == (fan == 3 ? 2 : 0));
    CHECK(mentions(without.err, "leaves none but where quads of the input enclose them; --cleanup-only changes") ==
          (fan == 3));
  }
}

namespace {

void add_stretched_surface(int tag) {
  // Equilateral triangles, stretched 20 to 1, and no rows that stand on a wall.
  std::vector<std::size_t> nodes, triangles, corners;
  std::vector<double> xyz;
  constexpr int kRows = 12, kColumns = 24;
  const std::size_t first = 1000 * (tag - 1) + 1;
  for (int j = 0; j <= kRows; ++j)
    for (int i = 0; i <= kColumns; ++i) {
      nodes.push_back(first + nodes.size());
      xyz.insert(xyz.end(), {20 * (i + 0.5 * j), 0.87 * j, 10.0 * tag});
    }
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kColumns; ++i) {
      const std::size_t a = first + j * (kColumns + 1) + i, d = a + kColumns + 1;
      corners.insert(corners.end(), {a, a + 1, d, a + 1, d + 1, d});
    }
  gmsh::model::addDiscreteEntity(2, tag);
  gmsh::model::mesh::addNodes(2, tag, nodes, xyz);
  for (std::size_t i = 0; i < corners.size() / 3; ++i) triangles.push_back(first + i);
  gmsh::model::mesh::addElementsByType(tag, 2, triangles, corners);
}

/// Whether no quad has a scaled Jacobian under 0.3 where the triangles of a geometry are converted.
bool becomes_good_quads(const std::string& geometry) {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", geometry);
  {
    const RunningGmsh running;
    gmsh::option::setNumber("General.Verbosity", 0);
    gmsh::open(directory / "in.geo");
    gmsh::model::mesh::generate(2);
    gmsh::write(directory / "in.msh");
  }
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  return run_qmorph({directory / "out.msh", "--check", "--min-sj", "0.3"}).status == 0;
}

}  // namespace

TEST_CASE("layers of Gmsh: where those of two walls end close to each other, the front has room for good quads") {
  CHECK(becomes_good_quads(
      "Point(1)={0,.7,0,.0449}; Point(2)={0,0,0,.0449}; Point(3)={.5,0,0,.0449}; Point(4)={.5,.7,0,.0449};\n"
      "Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1}; Curve Loop(1)={1:4}; Plane Surface(1)={1};\n"
      "Field[1]=BoundaryLayer; Field[1].EdgesList={1,2}; Field[1].NodesList={1,3}; Field[1].hwall_n=.0005;\n"
      "Field[1].ratio=1.36; Field[1].thickness=.058; Field[1].hfar=.1; Field[1].Quads=0;\n"
      "BoundaryLayer Field=1;\n"));
}

TEST_CASE("layers of Gmsh: a channel's end may lean, and rows go on to it") {
  CHECK(becomes_good_quads(
      "Point(1)={0,0,0,.08}; Point(2)={1,0,0,.08}; Point(3)={1.7,.7,0,.08}; Point(4)={.7,.7,0,.08};\n"
      "Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1}; Curve Loop(1)={1:4}; Plane Surface(1)={1};\n"
      "Field[1]=BoundaryLayer; Field[1].EdgesList={1,3}; Field[1].NodesList={1,2,3,4}; Field[1].hwall_n=.002;\n"
      "Field[1].ratio=1.3; Field[1].thickness=.12; Field[1].hfar=.08; Field[1].Quads=0;\n"
      "BoundaryLayer Field=1;\n"));
}

TEST_CASE("layers of Gmsh: cells that lie nearly along the curve on which a layer ends are left to the front") {
  CHECK(becomes_good_quads(  // half a foil on its line of symmetry
      "Point(1)={-1,0,0,.2}; Point(2)={0,0,0,.03}; Point(3)={.3,.1,0,.1}; Point(4)={1,0,0,.03};\n"
      "Point(5)={2,0,0,.2}; Point(6)={2,1,0,.2}; Point(7)={-1,1,0,.2};\n"
      "Line(1)={1,2}; Spline(2)={2,3,4}; Line(3)={4,5}; Line(4)={5,6}; Line(5)={6,7}; Line(6)={7,1};\n"
      "Curve Loop(1)={1:6}; Plane Surface(1)={1};\n"
      "Field[1]=BoundaryLayer; Field[1].EdgesList={2}; Field[1].NodesList={2,4}; Field[1].hwall_n=.001;\n"
      "Field[1].ratio=1.3; Field[1].thickness=.03; Field[1].hfar=.3; Field[1].Quads=0;\n"
      "BoundaryLayer Field=1;\n"));
}

TEST_CASE("layers of Gmsh: --layers=off leaves them to the front, and a warning and --check say so") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [] { add_stretched_surface(1); });
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--layers=off"});
  CHECK(mentions(result.err, "warning: surface 1: its quads are "));
  const Result judged =
      run_qmorph({"--check", directory / "out.msh", "--against", directory / "in.msh", "--max-size-ratio", "1.5"});
  CAPTURE(judged.err);
  CHECK(judged.status == 6);
  CHECK(mentions(judged.err, "qmorph: surface 1: its quads are "));
  CHECK(mentions(judged.out, "; size "));
  CHECK(run_qmorph({"--check", directory / "out.msh", "--against", directory / "in.msh"}).status == 0);
}

TEST_CASE("messages: a warning that many surfaces have, but for its numbers, is one line") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [] {
    for (int tag = 1; tag <= 5; ++tag) add_stretched_surface(tag);
  });
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--layers=off"});
  CAPTURE(result.err);
  CHECK(mentions(result.err, "warning: surface 1: its quads are "));
  CHECK(mentions(result.err, "; the like of 4 others: 2, 3, 4, 5\n"));
  CHECK(!mentions(result.err, "warning: surface 2"));
}

TEST_CASE("layers of Gmsh: where rows end at a steep side, most quads are good all the same") {
  // The end of the rows has many nodes, and the side that it faces has few: a front has no room between them.
  const TemporaryDirectory directory;
  write_file(directory / "in.geo",
             "Point(1) = {0, 0, 0, .1}; Point(2) = {2, 0, 0, .1}; Point(3) = {3, 1, 0, .1}; Point(4) = {1, 2, 0, .1};\n"
             "Point(5) = {0, 1, 0, .1}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5};\n"
             "Line(5) = {5, 1}; Curve Loop(1) = {1:5}; Plane Surface(1) = {1}; Recombine Surface{1};\n"
             "Field[1] = BoundaryLayer; Field[1].EdgesList = {1}; Field[1].hfar = .1; Field[1].hwall_n = .01;\n"
             "Field[1].ratio = 1.1; Field[1].thickness = .2; Field[1].AnisoMax = 100; BoundaryLayer Field = 1;\n"
             "Field[2] = Distance; Field[2].PointsList = {3}; Field[3] = Threshold; Field[3].InField = 2;\n"
             "Field[3].SizeMin = .01; Field[3].SizeMax = .1; Field[3].DistMin = .05; Field[3].DistMax = .4;\n"
             "Background Field = 3;\n");
  const Result result =
      run_qmorph({directory / "in.geo", "-o", directory / "out.msh", "--stats", directory / "out.json"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  CHECK(figure(read_file(directory / "out.json"), "share_below_0.3") < 0.1);
}

TEST_CASE("check: sizes are compared with another mesh, which has to be named") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", extruded_wall(false));
  REQUIRE(run_qmorph({directory / "in.geo", "-o", directory / "out.msh"}).status == 0);
  CHECK(run_qmorph({"--check", directory / "out.msh", "--max-size-ratio", "1.5"}).status == 1);
  CHECK(run_qmorph({"--check", directory / "out.msh", "--against", directory / "none.msh"}).status == 2);
  CHECK(run_qmorph({"--check", directory / "out.msh", "--against", directory / "in.geo"}).status == 2);
  CHECK(run_qmorph({directory / "out.msh", "--against", directory / "in.geo"}).status == 1);
  CHECK(run_qmorph({directory / "in.geo", "--layers=maybe"}).status == 1);
}
