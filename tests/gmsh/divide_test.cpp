// SPDX-License-Identifier: GPL-2.0-or-later
/// From a geometry: how many segments each curve gets.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gmsh/divide/crossings.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"
#include "support/rng.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

const adapter::EntityMesh& curve(const Snapshot& snapshot, int tag) {
  const adapter::EntityMesh* found = adapter::find_entity(snapshot.mesh, 1, tag);
  REQUIRE(found);
  return *found;
}

std::size_t segments(const Snapshot& snapshot, int tag) { return curve(snapshot, tag).element_count(); }

/// In the order of the elements.
std::vector<double> lengths(const Snapshot& snapshot, int tag) {
  std::vector<double> all;
  for (const auto& block : curve(snapshot, tag).blocks)
    for (std::size_t i = 0; i < block.nodes.size(); i += 2) {
      const auto& points = snapshot.mesh.points;
      const auto& rows = snapshot.mesh.rows;
      all.push_back((points[rows.find(block.nodes[i])] - points[rows.find(block.nodes[i + 1])]).norm());
    }
  return all;
}

struct Converted {
  Snapshot snapshot;
  double worst = 0;  ///< scaled Jacobian
};

Converted convert(const std::string& script, std::vector<std::string> more = {}) {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", script);
  std::vector<std::string> words = {directory / "in.geo",   "-o",       directory / "out.msh", "--stats",
                                    directory / "out.json", "-save_all"};
  words.insert(words.end(), more.begin(), more.end());
  const Result result = run_qmorph(words);
  CAPTURE(script);
  CAPTURE(result.err);
  REQUIRE(result.status == 0);
  const auto total = nlohmann::json::parse(read_file(directory / "out.json"))["total"];
  CHECK(total["triangles"] == 0);
  return {read_snapshot(directory / "out.msh"), total["scaled_jacobian"]["min"]};
}

/// A thin ring between a disc and a ring of iron: its inner circle in `inner` arcs, its outer one in `outer`.
std::string motor(int inner, int outer, double gap, double size, double turn) {
  std::string script = "Point(1000) = {0, 0, 0};\n";
  std::vector<std::string> loops;
  int points = 0, arcs = 0;
  const auto circle = [&](int count, double radius, double where) {
    const int first_point = points + 1, first_arc = arcs + 1;
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * M_PI * k / count + where;
      script += fmt::format("Point({}) = {{{}, {}, 0, {}}};\n", ++points, radius * std::cos(angle),
                            radius * std::sin(angle), size);
    }
    for (int k = 0; k < count; ++k)
      script += fmt::format("Circle({}) = {{{}, 1000, {}}};\n", ++arcs, first_point + k, first_point + (k + 1) % count);
    loops.push_back(fmt::format("{}", loops.size() + 1));
    script += fmt::format("Curve Loop({}) = {{{}:{}}};\n", loops.size(), first_arc, arcs);
  };
  circle(inner, 1, 0);
  circle(outer, 1 + gap, turn);
  circle(4, 1.5, 0);
  return script + "Plane Surface(1) = {1};\nPlane Surface(2) = {2, 1};\nPlane Surface(3) = {3, 2};\n";
}

}  // namespace

TEST_CASE("divide: the two sides of a thin ring get equally many segments, wherever they are cut") {
  Rng rng(1);
  for (int trial = 0; trial < 6; ++trial) {
    const int inner = rng.range(3, 7), outer = rng.range(3, 7);
    const double size = rng.between(0.03, 0.06), gap = rng.between(0.9, 1.1) * size;
    CAPTURE(trial);
    const auto [after, worst] = convert(motor(inner, outer, gap, size, rng.uniform()));
    std::size_t one = 0, other = 0;
    for (int k = 1; k <= inner + outer; ++k) (k <= inner ? one : other) += segments(after, k);
    CHECK(one == other);
    CHECK(worst > 0.55);
  }
}

TEST_CASE("divide: a frame whose sides have as many segments as rows that turn in its corners ask for keeps them") {
  struct Frame {
    double thickness, size;
    std::size_t outer, inner;
  };
  for (const Frame& frame : {Frame{0.1, 0.1, 10, 8}, Frame{0.13, 0.06, 17, 13}, Frame{0.05, 0.04, 25, 23}}) {
    CAPTURE(frame.thickness);
    CAPTURE(frame.size);
    std::string script;
    int corner = 0;
    for (const double from : {0.0, frame.thickness})
      for (const auto& [x, y] : {std::pair{from, from}, {1 - from, from}, {1 - from, 1 - from}, {from, 1 - from}})
        script += fmt::format("Point({}) = {{{}, {}, 0, {}}};\n", ++corner, x, y, frame.size);
    for (int k = 0; k < 8; ++k)
      script += fmt::format("Line({}) = {{{}, {}}};\n", k + 1, k + 1, k / 4 * 4 + (k + 1) % 4 + 1);
    script += "Curve Loop(1) = {1:4};\nCurve Loop(2) = {5:8};\nPlane Surface(1) = {1, 2};\n";
    const auto [after, worst] = convert(script);
    for (int k = 1; k <= 8; ++k) CHECK(segments(after, k) == (k <= 4 ? frame.outer : frame.inner));
    CHECK(worst > 0.9);
  }
}

TEST_CASE("divide: ribs on a plate have no triangle and no poor quad") {
  Rng rng(2);
  for (int trial = 0; trial < 6; ++trial) {
    CAPTURE(trial);
    const int ribs = rng.range(2, 5);
    const double base = rng.between(0.05, 0.1);
    std::string script =
        fmt::format("SetFactory(\"OpenCASCADE\");\nRectangle(1) = {{0, 0, 0, {}, {}}};\n", 0.4 * ribs, base);
    for (int k = 0; k < ribs; ++k)
      script += fmt::format("Rectangle({}) = {{{}, {}, 0, {}, {}}};\n", k + 2, 0.1 + 0.38 * k, base,
                            rng.between(0.04, 0.08), rng.between(0.4, 1.0));
    script +=
        fmt::format("BooleanFragments{{Surface{{1}}; Delete;}}{{Surface{{2:{}}}; Delete;}}\nMeshSize{{:}} = {};\n",
                    ribs + 1, rng.between(0.03, 0.05));
    CHECK(convert(script).worst > 0.6);
  }
}

TEST_CASE("divide: where thin wings end at a body, the curve that runs past has nodes across from its corners") {
  Rng rng(3);
  for (int trial = 0; trial < 8; ++trial) {
    CAPTURE(trial);
    const double left = rng.between(0.5, 1.5), right = rng.between(0.5, 1.5), thin = rng.between(0.002, 0.02);
    const std::string script = fmt::format(
        "s = {};\nPoint(1) = {{0, 0, 0, s}};\nPoint(2) = {{1, 0, 0, s}};\nPoint(3) = {{1, 1, 0, s}};\n"
        "Point(4) = {{{}, 1, 0, s}};\nPoint(5) = {{{}, {}, 0, s}};\nPoint(6) = {{{}, {}, 0, s}};\n"
        "Point(7) = {{{}, 1, 0, s}};\nPoint(8) = {{0, 1, 0, s}};\nFor i In {{1:8}}\n"
        "Line(i) = {{i, i % 8 + 1}};\nEndFor\nCurve Loop(1) = {{1:8}};\nPlane Surface(1) = {{1}};\n",
        rng.between(0.1, 0.2), 1 + right, 1 + right, 1 + thin, -left, 1 + thin, -left);
    const auto [after, worst] = convert(script);
    const auto& points = after.mesh.points;
    for (double x : {0.0, 1.0})
      CHECK(std::any_of(points.begin(), points.end(), [&](const Eigen::Vector3d& p) {
        return std::abs(p.x() - x) < 1e-6 && std::abs(p.y() - 1 - thin) < 1e-9;
      }));
    CHECK(worst > 0.25);
  }
}

TEST_CASE("divide: a short straight spline is one segment, a bent one is not") {
  const auto strip = [](double bend) {
    return fmt::format(
        "Point(1) = {{0, 0, 0, 0.1}};\nPoint(2) = {{1.3, 0, 0, 0.1}};\nPoint(3) = {{1.3, 0.02, 0, 0.1}};\n"
        "Point(4) = {{0, 0.02, 0, 0.1}};\nPoint(5) = {{{}, 0.01, 0, 0.1}};\nLine(1) = {{1, 2}};\n"
        "Spline(2) = {{2, 5, 3}};\nLine(3) = {{3, 4}};\nSpline(4) = {{4, 1}};\nCurve Loop(1) = {{1:4}};\n"
        "Plane Surface(1) = {{1}};\n",
        1.3 + bend);
  };
  const auto [straight, worst] = convert(strip(0));
  CHECK(segments(straight, 2) == 1);
  CHECK(segments(straight, 4) == 1);
  CHECK(worst > 0.9);
  CHECK(segments(convert(strip(0.005)).snapshot, 2) == 2);
}

TEST_CASE("divide: an edge shorter than the size stays one segment") {
  const auto [after, worst] = convert(
      "Point(1) = {0, 0, 0, 0.2}; Point(2) = {2, 0, 0, 0.2}; Point(3) = {2, 0.9, 0, 0.2}; Point(4) = {1.9, 1, 0, "
      "0.2};\n"
      "Point(5) = {0, 1, 0, 0.2};\nLine(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = "
      "{5, 1};\n"
      "Curve Loop(1) = {1:5}; Plane Surface(1) = {1};\n");
  CHECK(segments(after, 3) == 1);
  CHECK(worst > 0.3);
}

TEST_CASE("divide: each side of a small triangle in a plate has two segments, and no quad is poor") {
  Rng rng(3);
  for (int trial = 0; trial < 6; ++trial) {
    // Of sides that are about as long as a size, and nearly alike.
    const double turn = rng.between(0, 2 * M_PI), radius = rng.between(0.2, 0.27);
    std::string script = "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {-2, -2, 0, 4, 4};\n";
    for (int k = 0; k < 3; ++k) {
      const double angle = turn + (2 * k + rng.between(-0.2, 0.2)) * M_PI / 3;
      script +=
          fmt::format("Point({}) = {{{}, {}, 0}};\n", 101 + k, radius * std::cos(angle), radius * std::sin(angle));
    }
    script +=
        "Line(101) = {101, 102}; Line(102) = {102, 103}; Line(103) = {103, 101};\nCurve Loop(101) = {101:103}; Plane "
        "Surface(2) = {101};\nBooleanFragments{Surface{1}; Delete;}{Surface{2}; Delete;}\nMesh.MeshSizeMax = 0.5;\n";
    const auto [after, worst] = convert(script);
    CAPTURE(trial);
    int sides = 0;
    for (const adapter::EntityMesh& entity : after.mesh.entities)
      if (entity.dim == 1 && entity.element_count() == 2) ++sides;
    CHECK(sides == 3);
    CHECK(worst > 0.55);
  }
}

TEST_CASE("divide: where another curve can make a boundary even, those at an acute corner keep Gmsh's numbers") {
  // A kite with a corner of about 30 degrees: two sides of 20 segments, and 23 on the others. By its length a long side
  // costs least to change.
  const Snapshot after =
      convert(
          "Point(1) = {0, 0, 0, 0.1}; Point(2) = {1.9, 0.52, 0, 0.1}; Point(3) = {2.63, 0.24, 0, 0.1};\n"
          "Point(4) = {2.63, -0.45, 0, 0.1}; Point(5) = {1.9, -0.52, 0, 0.1};\n"
          "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};\n"
          "Curve Loop(1) = {1:5}; Plane Surface(1) = {1};\n")
          .snapshot;
  CHECK(segments(after, 1) == 20);
  CHECK(segments(after, 5) == 20);
}

TEST_CASE("divide: a graded curve keeps its grading with another number of segments") {
  // 1 to 10 along the bottom. A kept curve at the top makes the sum odd or even.
  const auto script = [](double top) {
    return fmt::format(
        "Point(1) = {{0, 0, 0, 0.02}}; Point(2) = {{2, 0, 0, 0.2}}; Point(3) = {{2, 1, 0, 0.2}}; Point(4) = {{0, {}, "
        "0, 0.1}};\n"
        "Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 1}};\n"
        "Curve Loop(1) = {{1:4}}; Plane Surface(1) = {{1}};\n",
        top);
  };
  for (const double top : {0.8, 0.9, 1.0, 1.1}) {
    CAPTURE(top);
    const auto [after, worst] = convert(script(top));
    const std::vector<double> along = lengths(after, 1);
    CHECK(along.back() / along.front() > 5.5);
    CHECK(along.back() / along.front() < 10);
    for (std::size_t i = 1; i < along.size(); ++i) {
      CHECK(along[i] / along[i - 1] > 0.98);
      CHECK(along[i] / along[i - 1] < 1.25);
    }
  }
}

TEST_CASE("divide: curves that are to be kept keep Gmsh's number") {
  // 7 + 5 + 7 + 6 and a hole of 5 + 5: one of all has to give way.
  const std::string script =
      "Point(1) = {0, 0, 0, 0.15}; Point(2) = {1, 0, 0, 0.15}; Point(3) = {1, 0.7, 0, 0.15}; Point(4) = {0, 0.85, 0, "
      "0.15};"
      "\nLine(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4};\n"
      "Point(5) = {0.5, 0.35, 0}; Point(6) = {0.7, 0.35, 0, 0.15}; Point(7) = {0.3, 0.35, 0, 0.15};\n"
      "Circle(5) = {6, 5, 7}; Circle(6) = {7, 5, 6}; Curve Loop(2) = {5, 6};\nPlane Surface(1) = {1, 2};\n";
  const Snapshot free = convert(script).snapshot;
  std::size_t odd_one_out = 0;
  for (const char* kept : {"1", "2", "3", "4", "5", "6"}) {
    const Snapshot after = convert(script, {"--keep-curves", kept}).snapshot;
    odd_one_out += segments(after, std::stoi(kept)) != segments(free, std::stoi(kept));
  }
  CHECK(odd_one_out == 1);
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", script);
  const Result unknown = run_qmorph({directory / "in.geo", "-o", directory / "out.msh", "--keep-curves", "3,99"});
  CHECK(unknown.status == 1);
  CHECK(unknown.err.find("no curve 99") != std::string::npos);
}

TEST_CASE("divide: regions that embedded curves cut off are even, each for itself") {
  convert(
      "Point(1) = {0, 0, 0, 0.15}; Point(2) = {2, 0, 0, 0.15}; Point(3) = {2, 1, 0, 0.15}; Point(4) = {0, 1, 0, "
      "0.15};\n"
      "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4};\n"
      "Plane Surface(1) = {1};\n"
      "Point(5) = {0.5, 0.3, 0, 0.15}; Point(6) = {1.2, 0.3, 0, 0.15}; Point(7) = {0.8, 0.8, 0, 0.15};\n"
      "Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 5}; Line(8) = {1, 5}; Curve{5:8} In Surface{1};\n");
}

TEST_CASE("divide: a curve of no surface that happens to part one leaves both parts even") {
  const Converted converted = convert(
      "Point(1) = {0, 0, 0}; Point(2) = {0.2, 0, 0}; Point(3) = {0.2, 3.2, 0};\n"
      "Point(4) = {0.2, 4.8, 0}; Point(5) = {0, 4.8, 0}; Point(6) = {0, 3.2, 0};\n"
      "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};\n"
      "Line(7) = {3, 6}; Curve Loop(1) = {1:6}; Plane Surface(1) = {1}; Transfinite Curve {1, 4} = 3;\n"
      "Transfinite Curve {7} = 2; Transfinite Curve {2, 6} = 9; Transfinite Curve {3, 5} = 5;\n");
  CHECK(segments(converted.snapshot, 7) == 2);  // 19 and 11 sides otherwise
}

TEST_CASE("divide: where surfaces meet by threes in a curve, all of them are even") {
  Rng rng(24);
  for (int trial = 0; trial < 8; ++trial) {
    std::string script =
        "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {1, 0, 0, 1, 1, 1};\n"
        "BooleanFragments{ Volume{1:2}; Delete; }{}\n";
    for (int point = 1; point <= 12; ++point)
      script += fmt::format("MeshSize{{{}}} = {:.2f};\n", point, 0.15 + 0.35 * rng.uniform());
    convert(script);
  }
}

TEST_CASE("divide: circles that are as coarse as allowed can get one segment more") {
  const Converted converted = convert(
      "SetFactory(\"OpenCASCADE\"); Disk(1) = {0, 0, 0, 0.1}; Rectangle(2) = {-1, -1, 0, 2, 2};\n"
      "BooleanFragments{ Surface{1, 2}; Delete; }{}\nMeshSize{:} = 0.5;\n");
  const adapter::ModelMesh& mesh = converted.snapshot.mesh;
  const auto circle = std::find_if(mesh.entities.begin(), mesh.entities.end(), [](const adapter::EntityMesh& entity) {
    return entity.dim == 1 && entity.element_count() > 4;
  });
  REQUIRE(circle != mesh.entities.end());
  CHECK(circle->element_count() == 8);  // of Gmsh: 7
}

TEST_CASE("divide: both sides of a crescent get as many segments, and only the quads in its tips are poor") {
  const auto [snapshot, worst] = convert(R"(SetFactory("OpenCASCADE");
    Disk(1) = {0, 0, 0, 1}; Disk(2) = {0.1, 0, 0, 1};
    BooleanDifference{ Surface{1}; Delete; }{ Surface{2}; Delete; }
    Mesh.MeshSizeMax = 0.2;)");
  CHECK(segments(snapshot, 1) == segments(snapshot, 2));
  CHECK(worst > 0.09);  // the sine of the tips' angle between chords is 0.094
}

TEST_CASE("divide: a circle that touches another one from inside") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", R"(SetFactory("OpenCASCADE");
    Disk(1) = {0, 0, 0, 1}; Disk(2) = {0.15, 0, 0, 0.85};
    BooleanDifference{ Surface{1}; Delete; }{ Surface{2}; Delete; }
    Mesh.MeshSizeMax = 0.2;)");
  REQUIRE(run_qmorph({directory / "in.geo", "-o", directory / "out.msh", "--stats", directory / "out.json"}).status ==
          0);
  const auto total = nlohmann::json::parse(read_file(directory / "out.json"))["total"];
  CHECK(total["triangles"] == 0);
  // Two in the cusp, of an angle of one degree between chords.
  CHECK(total["scaled_jacobian"]["share_below_0.3"].get<double>() * total["quads"].get<double>() < 4.5);
}

TEST_CASE(
    "divide: where an arc and a line that it touches run out in a tip, the first segments are as long as a quad "
    "needs") {
  for (const double size : {0.1, 0.15}) {
    CAPTURE(size);
    const auto [snapshot, worst] = convert(fmt::format(R"(Point(1) = {{0, 0, 0}}; Point(2) = {{1, 0, 0}};
      Point(3) = {{1, 1, 0}}; Point(4) = {{0, 1, 0}};
      Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Circle(3) = {{3, 4, 1}};
      Curve Loop(1) = {{1, 2, 3}}; Plane Surface(1) = {{1}};
      Mesh.MeshSizeMax = {};)",
                                                       size));
    const std::vector<double> line = lengths(snapshot, 1), arc = lengths(snapshot, 3);
    CHECK(line.front() > 2.5 * size);
    CHECK(std::max(arc.front(), arc.back()) == doctest::Approx(line.front()).epsilon(0.05));
    CHECK(worst > 1.3 * size);  // with segments of the size 0.45 times it
  }
}

TEST_CASE("divide: first segments in a tip keep their length where a boundary needs another number") {
  // A quarter of a ring that thins out: with three segments on its inner side the angle in its tip would be too small.
  for (const double size : {0.5, 0.7}) {
    CAPTURE(size);
    CHECK(convert(fmt::format(R"(SetFactory("OpenCASCADE");
      Point(1) = {{0, 0, 0}}; Point(2) = {{2, 0, 0}}; Point(3) = {{1, 1, 0}}; Point(4) = {{0, 1, 0}};
      Point(5) = {{2, 1, 0}};
      Line(1) = {{1, 2}}; Line(2) = {{2, 5}}; Line(3) = {{5, 3}}; Circle(4) = {{3, 4, 1}};
      Curve Loop(1) = {{1, 2, 3, 4}}; Plane Surface(1) = {{1}};
      Mesh.MeshSizeMax = {};)",
                              size))
              .worst > 0.25);
  }
}

TEST_CASE("divide: a seam whose only segment is an edge of another surface does not leave that odd") {
  // The inner half of a torus, cut across its hole; Gmsh 4.13 cannot mesh a whole torus cut there.
  convert(R"(SetFactory("OpenCASCADE");
    Circle(1) = {1, 0, 0, 0.4, Pi/2, 3*Pi/2}; Line(2) = {2, 1}; Curve Loop(1) = {1, 2}; Plane Surface(1) = {1};
    Rotate{{1, 0, 0}, {0, 0, 0}, Pi/2} { Surface{1}; } Extrude{{0, 0, 1}, {0, 0, 0}, 2*Pi}{ Surface{1}; }
    Recursive Delete{ Surface{1}; } Box(2) = {0.62, -3, -3, 4, 6, 6};
    BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
    Mesh.MeshSizeMax = 0.4;)");
}

TEST_CASE("divide: where two curves come close and part again, nodes face each other") {
  const auto [snapshot, worst] = convert(R"(SetFactory("OpenCASCADE");
    Rectangle(1) = {0, 0, 0, 3, 1}; Disk(2) = {1.5, 1.02, 0, 1};
    BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; }
    Mesh.MeshSizeMax = 0.36171;)");
  CHECK(worst > 0.3);
}

TEST_CASE("divide: where the short end of a rib is close to the edge of a plate, that has a segment as short") {
  for (const double gap : {0.03, 0.1, 0.2}) {
    CAPTURE(gap);
    const auto [snapshot, worst] = convert(fmt::format(R"(SetFactory("OpenCASCADE");
      Rectangle(1) = {{0, 0, 0, 12, 8}}; Rectangle(2) = {{3.3, {}, 0, 0.44, 5}};
      BooleanDifference{{ Surface{{1}}; Delete; }}{{ Surface{{2}}; Delete; }}
      Mesh.MeshSizeMax = 1;)",
                                                       gap));
    CHECK(worst > 0.35);
  }
}

TEST_CASE("divide: a coarse circle that cannot have a segment fewer has one more") {
  const auto [snapshot, worst] = convert(R"(SetFactory("OpenCASCADE");
    Cylinder(1) = {0, 0, 0, 0, 0, 0.4, 0.15}; Dilate{{0, 0, 0}, {5, 5, 5}} { Volume{1}; }
    Mesh.MeshSizeMin = 1; Mesh.MeshSizeMax = 1;)");
  CHECK(segments(snapshot, 1) == 6);  // of Gmsh: 5
  CHECK(segments(snapshot, 1) == segments(snapshot, 3));
  const std::vector<double> circle = lengths(snapshot, 1);
  CHECK(*std::max_element(circle.begin(), circle.end()) < 1.05 * *std::min_element(circle.begin(), circle.end()));
}

TEST_CASE("divide: closed curves that come close to others get a node there, too") {
  for (const char* holes : {"Disk(2) = {-0.7, 0, 0, 0.68}; Disk(3) = {0.7, 0.1, 0, 0.7};",
                            "Disk(2) = {1.16, 0.3, 0, 0.78}; Disk(3) = {-1.27, 0, 0, 0.7};"}) {
    CAPTURE(holes);
    const auto [snapshot, worst] = convert(fmt::format(R"(SetFactory("OpenCASCADE");
      Rectangle(1) = {{-2, -2, 0, 4, 4}}; {}
      BooleanDifference{{ Surface{{1}}; Delete; }}{{ Surface{{2, 3}}; Delete; }}
      Mesh.MeshSizeMax = 0.25;)",
                                                       holes));
    CHECK(worst > 0.5);
  }
}

TEST_CASE("divide: ends of curves that differ by the tolerance of the geometry do not make a boundary cross itself") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [] {
    ::gmsh::model::occ::addRectangle(0, 0, 0, 1, 1);
    ::gmsh::model::occ::synchronize();
    ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.25);
    std::optional<adapter::CurveModel> model = adapter::divide_as_wished({1});
    REQUIRE(model);
    const std::vector<int> segments(model->curves.size(), 4);
    CHECK(!adapter::crosses_itself(*model, model->surfaces[0], segments));
    model->curves[0].points.front() += Eigen::Vector3d(-1e-5, 1e-5, 0);
    CHECK(!adapter::crosses_itself(*model, model->surfaces[0], segments));
    ::gmsh::model::mesh::generate(2);
  });
}

TEST_CASE("divide: a curved surface that is meshed too coarsely to show its shape gets finer curves") {
  struct Shape {
    const char *script, *size;
    double worst;
  };
  for (const Shape& shape : {
           Shape{"Torus(1) = {0, 0, 0, 12, 4};", "4", 0.45},       // Gmsh: no mesh
           Shape{"Torus(1) = {0, 0, 0, 12, 4};", "6", 0.6},        // one segment around
           Shape{"Torus(1) = {0, 0, 0, 12, 4, Pi};", "10", 0.45},  // half the area
           Shape{"Cylinder(1) = {0, 0, 0, 0, 0, 10, 1};", "6", 0.4},
       }) {
    CAPTURE(shape.script);
    CHECK(convert(std::string("SetFactory(\"OpenCASCADE\");\n") + shape.script, {"-clscale", shape.size}).worst >
          shape.worst);
  }
}

TEST_CASE("divide: a coarse tube that shows its shape gets no finer curves") {
  const Converted tube =
      convert("SetFactory(\"OpenCASCADE\");\nCylinder(1) = {0, 0, 0, 0, 0, 10, 1};", {"-clscale", "3"});
  CHECK(segments(tube.snapshot, 1) <= 8);
}
