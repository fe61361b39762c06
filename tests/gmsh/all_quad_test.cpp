// SPDX-License-Identifier: GPL-2.0-or-later
/// --all-quad and session::make_even(): curves get as few nodes as it takes for all boundaries to be even.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "gmsh/convert/periodic.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"
#include "qmorph/gmsh.hpp"

using namespace qmorph;
using namespace qmorph::test;
using nlohmann::json;

namespace {

/// Two squares, 1 and 2, that share curve 2 with three segments. All other sides have four, the lower one of
/// square 1 (curve 1) has `lower`.
std::string two_squares(int lower) {
  return fmt::format(R"(
    Point(1) = {{0, 0, 0}}; Point(2) = {{1, 0, 0}}; Point(3) = {{1, 1, 0}}; Point(4) = {{0, 1, 0}};
    Point(5) = {{2, 0, 0}}; Point(6) = {{2, 1, 0}};
    Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 1}};
    Line(5) = {{2, 5}}; Line(6) = {{5, 6}}; Line(7) = {{6, 3}};
    Transfinite Curve {{3, 4, 5, 6, 7}} = 5; Transfinite Curve {{2}} = 4; Transfinite Curve {{1}} = {} + 1;
    Curve Loop(1) = {{1, 2, 3, 4}}; Plane Surface(1) = {{1}};
    Curve Loop(2) = {{5, 6, 7, -2}}; Plane Surface(2) = {{2}};
    Physical Surface("left", 10) = {{1}}; Physical Surface("right", 11) = {{2}};
    Physical Curve("between", 12) = {{2}}; Physical Curve("outer", 13) = {{1, 3, 4, 5, 6, 7}};
  )",
                     lower);
}

void make_squares(const TemporaryDirectory& directory, int lower, double version = 4.1, bool binary = false) {
  write_file(directory / "in.geo", two_squares(lower));
  make_msh(directory / "in.msh", version, binary, [&] {
    ::gmsh::merge(directory / "in.geo");
    ::gmsh::model::mesh::generate(2);
  });
}

struct Outcome {
  int status;
  json report;
  std::string err;
  std::set<int> split_curves() const {
    std::set<int> curves;
    for (const json& split : report["all_quad"]["splits"]) curves.insert(split["curve"].get<int>());
    return curves;
  }
};

Outcome run_all_quad(const TemporaryDirectory& directory, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments = {directory / "in.msh", "-o",      directory / "out.msh",
                                        "--all-quad",         "--stats", directory / "s.json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Result result = run_qmorph(arguments);
  CAPTURE(result.err);
  REQUIRE((result.status == 0 || result.status == 3));
  return {result.status, json::parse(read_file(directory / "s.json")), result.err};
}

const adapter::EntityMesh* find_entity(const Snapshot& snapshot, int dim, int tag) {
  for (const adapter::EntityMesh& entity : snapshot.mesh.entities)
    if (entity.dim == dim && entity.tag == tag) return &entity;
  return nullptr;
}

/// What is not as it was: curves and points but the split ones, nodes that are gone, groups.
void check_rest(const TemporaryDirectory& directory, const std::set<int>& split, std::size_t order = 1) {
  const Snapshot before = read_snapshot(directory / "in.msh"), after = read_snapshot(directory / "out.msh");
  CHECK(before.groups == after.groups);
  for (const adapter::EntityMesh& entity : before.mesh.entities) {
    if (entity.dim > 1) continue;
    CAPTURE(entity.dim);
    CAPTURE(entity.tag);
    const adapter::EntityMesh* same = find_entity(after, entity.dim, entity.tag);
    REQUIRE(same);
    const bool is_split = entity.dim == 1 && split.count(entity.tag);
    CHECK(same->element_count() == entity.element_count() + is_split);
    REQUIRE(same->node_tags.size() == entity.node_tags.size() + is_split * order);
    for (std::size_t tag : entity.node_tags) {
      const Index old_row = before.mesh.rows.find(tag), row = after.mesh.rows.find(tag);
      REQUIRE(row != kNone);
      CHECK(before.mesh.points[old_row] == after.mesh.points[row]);
    }
    if (is_split || entity.blocks.empty()) continue;
    CHECK(same->blocks[0].nodes == entity.blocks[0].nodes);
    CHECK(same->blocks[0].tags == entity.blocks[0].tags);
  }
}

}  // namespace

TEST_CASE("--all-quad: two odd neighbours share one new node, and nothing else changes") {
  for (const auto& kind : {std::pair{4.1, false}, {4.1, true}, {2.2, false}, {2.2, true}}) {
    const double version = kind.first;
    const bool binary = kind.second;
    CAPTURE(version);
    CAPTURE(binary);
    const TemporaryDirectory directory;
    make_squares(directory, 4, version, binary);
    const Outcome outcome = run_all_quad(directory);
    CHECK(outcome.status == 0);
    CHECK(outcome.report["total"]["triangles"] == 0);
    CHECK(outcome.report["all_quad"]["odd_regions"] == 2);
    CHECK(outcome.report["all_quad"]["splits"].size() == 1);
    CHECK(outcome.split_curves() == std::set<int>{2});
    CHECK(outcome.report["all_quad"]["splits"][0]["surfaces"] == json{1, 2});
    CHECK(outcome.err.find("--all-quad: 1 segment got a node, on curve 2 (2 regions had an odd boundary)\n") !=
          std::string::npos);
    check_rest(directory, {2});
  }
}

TEST_CASE("--all-quad: one odd surface gets its node from the outside, by its longest segment") {
  const TemporaryDirectory directory;
  make_squares(directory, 5);
  const Outcome outcome = run_all_quad(directory);
  CHECK(outcome.report["total"]["triangles"] == 0);
  REQUIRE(outcome.report["all_quad"]["splits"].size() == 1);
  CHECK(outcome.report["all_quad"]["splits"][0]["surfaces"] == json{2});
  check_rest(directory, outcome.split_curves());
}

TEST_CASE("--keep-curves: others are split instead, and what cannot be even is named") {
  const TemporaryDirectory directory;
  make_squares(directory, 4);
  const Outcome outcome = run_all_quad(directory, {"--keep-curves", "2"});
  CHECK(outcome.report["total"]["triangles"] == 0);
  CHECK(outcome.report["all_quad"]["splits"].size() == 2);
  CHECK(outcome.split_curves().count(2) == 0);
  check_rest(directory, outcome.split_curves());

  const Outcome kept = run_all_quad(directory, {"--keep-curves", "1,2,3,4,5,6,7"});
  CHECK(kept.status == 0);
  CHECK(kept.report["total"]["triangles"] == 2);
  CHECK(kept.report["all_quad"]["splits"].empty());
  CHECK(kept.report["all_quad"]["odd_surfaces"] == json{1, 2});
  CHECK(kept.err.find("no way to make surfaces 1, 2 even") != std::string::npos);
  check_rest(directory, {});
}

TEST_CASE("--all-quad: surfaces that are not asked for and their curves stay") {
  const TemporaryDirectory directory;
  make_squares(directory, 4);
  const Outcome outcome = run_all_quad(directory, {"--surfaces", "1"});
  CHECK(outcome.report["total"]["triangles"] == 0);
  CHECK(outcome.split_curves().count(2) == 0);
  const Snapshot before = read_snapshot(directory / "in.msh"), after = read_snapshot(directory / "out.msh");
  CHECK(find_entity(before, 2, 2)->blocks[0].nodes == find_entity(after, 2, 2)->blocks[0].nodes);
  check_rest(directory, outcome.split_curves());
}

TEST_CASE("--all-quad: an even model is converted as without it") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [&] {
    write_file(directory / "in.geo",
               "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 1, 1}; "
               "Transfinite Curve {:} = 6;");
    ::gmsh::merge(directory / "in.geo");
    ::gmsh::model::mesh::generate(2);
  });
  run_all_quad(directory);
  const std::string with = read_file(directory / "out.msh");
  REQUIRE(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).status == 0);
  CHECK((with == read_file(directory / "out.msh")));
}

TEST_CASE("--all-quad: from a geometry, the new node lies on its curve") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", R"(
    SetFactory("OpenCASCADE"); Disk(1) = {0, 0, 0, 1}; Transfinite Curve {1} = 16; Physical Surface(1) = {1};
    Physical Curve(2) = {1};
  )");
  const Result result =
      run_qmorph({directory / "in.geo", "-o", directory / "out.msh", "--all-quad", "--stats", directory / "s.json"});
  CAPTURE(result.err);
  REQUIRE(result.status == 0);
  const json report = json::parse(read_file(directory / "s.json"));
  CHECK(report["total"]["triangles"] == 0);
  for (const json& split : report["all_quad"]["splits"])
    CHECK(std::hypot(split["where"][0].get<double>(), split["where"][1].get<double>()) == doctest::Approx(1));
}

TEST_CASE("--all-quad: surfaces of a file without line elements share the node of their common edge") {
  const TemporaryDirectory directory;
  // Two rectangles with three sides of their own and two that they share, of 0.4 and 0.6.
  write_file(directory / "in.msh", msh22({{0, 0, 0}, {1, 0, 0}, {1, .4, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}},
                                         {"2 2 0 1 1 2 3", "2 2 0 1 1 3 5", "2 2 0 1 3 4 5", "2 2 0 2 2 6 3",
                                          "2 2 0 2 6 7 3", "2 2 0 2 7 4 3"}));
  const Outcome outcome = run_all_quad(directory);
  CHECK(outcome.report["total"]["triangles"] == 0);
  REQUIRE(outcome.report["all_quad"]["splits"].size() == 1);
  CHECK(outcome.report["all_quad"]["splits"][0]["curve"] == 0);
  CHECK(outcome.report["all_quad"]["splits"][0]["where"] == json{1.0, 0.7, 0.0});
  CHECK(outcome.err.find("--all-quad: 1 segment got a node, on no curve (2 regions") != std::string::npos);
}

TEST_CASE("--all-quad: on curves of higher order all nodes stay and the new ones lie between them") {
  for (const int order : {2, 3}) {
    CAPTURE(order);
    const TemporaryDirectory directory;
    write_file(directory / "in.geo", two_squares(4));
    make_msh(directory / "in.msh", 4.1, false, [&] {
      ::gmsh::merge(directory / "in.geo");
      ::gmsh::model::mesh::generate(2);
      ::gmsh::model::mesh::setOrder(order);
    });
    const Outcome outcome = run_all_quad(directory);
    CHECK(outcome.status == 0);
    CHECK(outcome.report["total"]["triangles"] == 0);
    CHECK(outcome.split_curves() == std::set<int>{2});
    check_rest(directory, {2}, std::size_t(order));
  }
}

TEST_CASE("--all-quad: a curve of second order keeps its shape") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [] {
    ::gmsh::model::occ::addDisk(0, 0, 0, 1, 1);
    ::gmsh::model::occ::synchronize();
    ::gmsh::model::mesh::setTransfiniteCurve(1, 16);
    ::gmsh::model::mesh::generate(2);
    ::gmsh::model::mesh::setOrder(2);
  });
  const Outcome outcome = run_all_quad(directory);
  CHECK(outcome.status == 0);
  CHECK(outcome.report["total"]["triangles"] == 0);
  const Snapshot after = read_snapshot(directory / "out.msh");
  const double sagitta = 1 - std::cos(std::acos(-1) / 15);
  for (const auto& block : find_entity(after, 1, 1)->blocks)
    for (std::size_t tag : block.nodes)
      CHECK(1 - after.mesh.points[after.mesh.rows.find(tag)].norm() < sagitta * sagitta);
}

TEST_CASE("--all-quad: of periodic curves both get the node, and they stay periodic") {
  const TemporaryDirectory directory;
  // Two odd squares; the lower side of the one is the master of that of the other.
  make_msh(directory / "in.msh", 4.1, false, [&] {
    write_file(directory / "in.geo", R"(
      Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
      Point(5) = {3, 0, 0}; Point(6) = {4, 0, 0}; Point(7) = {4, 1, 0}; Point(8) = {3, 1, 0};
      Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
      Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
      Transfinite Curve {1:8} = 5; Transfinite Curve {3, 7} = 6;
      Curve Loop(1) = {1:4}; Plane Surface(1) = {1}; Curve Loop(2) = {5:8}; Plane Surface(2) = {2};
      Periodic Curve {5} = {1} Translate {3, 0, 0};
    )");
    ::gmsh::merge(directory / "in.geo");
    ::gmsh::model::mesh::generate(2);
  });
  const Outcome outcome = run_all_quad(directory, {"--keep-curves", "2,3,4,6,7,8"});
  CAPTURE(outcome.err);
  CHECK(outcome.status == 0);
  CHECK(outcome.report["total"]["triangles"] == 0);
  CHECK(outcome.split_curves() == std::set<int>{1, 5});
  CHECK(outcome.report["all_quad"]["splits"].size() == 2);
  const adapter::Session session;
  adapter::set_option("Mesh.IgnorePeriodicity", 0);
  adapter::run_logged([&] { ::gmsh::open(directory / "out.msh"); });
  const adapter::ModelMesh mesh = adapter::read_model_mesh();
  const auto links = adapter::read_periodic_links(mesh, 1);
  REQUIRE(links.size() == 1);
  CHECK(links[0].nodes.size() == 6);
  for (const auto& [slave, master] : links[0].nodes) {
    const Eigen::Vector3d step = mesh.points[mesh.rows.find(slave)] - mesh.points[mesh.rows.find(master)];
    CHECK((step - Eigen::Vector3d(3, 0, 0)).norm() < 1e-9);
  }
}

TEST_CASE("--all-quad: a node on periodic curves of one surface would change nothing, so another curve gets it") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [&] {
    write_file(directory / "in.geo", R"(
      SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 1, 1}; Transfinite Curve {2, 4, 3} = 5;
      Transfinite Curve {1} = 6; Periodic Curve {2} = {-4} Translate {1, 0, 0};
    )");
    ::gmsh::merge(directory / "in.geo");
    ::gmsh::model::mesh::generate(2);
  });
  const Outcome outcome = run_all_quad(directory);
  CHECK(outcome.status == 0);
  CHECK(outcome.report["total"]["triangles"] == 0);
  CHECK(outcome.split_curves() == std::set<int>{3});
}

TEST_CASE("make_even: in a running session, and what makes no sense is refused with the model unchanged") {
  const RunningGmsh gmsh;
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", two_squares(4));
  ::gmsh::merge(directory / "in.geo");
  ::gmsh::model::mesh::generate(2);
  CHECK_THROWS_AS(session::make_even({7}), UsageError);
  CHECK_THROWS_AS(session::make_even({}, {99}), UsageError);
  const EvenReport even = session::make_even();
  CHECK(even.odd_regions == 2);
  CHECK(even.splits.size() == 1);
  CHECK(session::make_even().odd_regions == 0);
  CHECK(session::recombine().total.triangles == 0);
}

TEST_CASE("make_even: a new node on a curve that arches turns no triangle over") {
  const RunningGmsh gmsh;
  namespace geo = ::gmsh::model::geo;
  // The arc rises to 0.08 over its chord; the triangle beside it has its third corner at 0.01.
  const int a = geo::addPoint(0, 0, 0), b = geo::addPoint(1, 0, 0), c = geo::addPoint(0.98, 0.01, 0);
  const int arc = geo::addCircleArc(a, geo::addPoint(0.5, -1.5225, 0), b);
  const std::vector<int> others{geo::addLine(b, c), geo::addSpline({c, geo::addPoint(0.5, 0.3, 0), a})};
  geo::addPlaneSurface({geo::addCurveLoop({arc, others[0], others[1]})}, 1);
  geo::synchronize();
  for (const int curve : {arc, others[0], others[1]}) ::gmsh::model::mesh::setTransfiniteCurve(curve, 2);
  ::gmsh::model::mesh::generate(2);
  CHECK(session::make_even({}, others).splits.size() == 1);
  std::vector<std::size_t> tags, nodes;
  ::gmsh::model::mesh::getElementsByType(2, tags, nodes);
  REQUIRE(tags.size() == 2);
  std::vector<double> areas;
  for (std::size_t i = 0; i < nodes.size(); i += 3) {
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::vector<double> xyz = adapter::placed_node(nodes[i + k]).xyz;
      p[k] = {xyz[0], xyz[1], xyz[2]};
    }
    areas.push_back((p[1] - p[0]).cross(p[2] - p[0]).z());
  }
  CHECK(areas[0] * areas[1] > 0);
}

TEST_CASE("--all-quad: messages that go with it") {
  const TemporaryDirectory directory;
  make_squares(directory, 4);
  const std::string in = directory / "in.msh", out = directory / "out.msh";
  CHECK(run_qmorph({in, "-o", out, "--all-quad", "--cleanup-only"}).status == 1);
  const Result alone = run_qmorph({in, "-o", out, "--keep-curves", "1"});
  CHECK(alone.status == 1);
  CHECK(alone.err.find("without --all-quad") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(out));
  CHECK(run_qmorph({in, "-o", out, "--all-quad", "--keep-curves", "99"}).status == 1);
}

TEST_CASE("--all-quad: where no surface can be converted, the output is the input") {
  const TemporaryDirectory directory;
  // An odd square that has one of its triangles twice.
  write_file(directory / "in.msh", msh22({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5, 1, 0}, {0, 1, 0}},
                                         {"2 2 0 1 1 2 3", "2 2 0 1 1 3 4", "2 2 0 1 1 4 5", "2 2 0 1 1 3 4"}));
  const Outcome outcome = run_all_quad(directory);
  CHECK(outcome.status == 3);
  CHECK_FALSE(outcome.report.contains("all_quad"));
  CHECK((read_file(directory / "in.msh") == read_file(directory / "out.msh")));
}

TEST_CASE("--all-quad: a grid of odd squares gets half as many nodes, which is the least") {
  // A node changes the parity of two regions at most.
  const int n = 4;
  std::string script = "SetFactory(\"OpenCASCADE\");\n";
  for (int i = 0; i < n * n; ++i) script += fmt::format("Rectangle({}) = {{{}, {}, 0, 1, 1}};\n", i + 1, i % n, i / n);
  script += "BooleanFragments{ Surface{:}; Delete; }{}\nTransfinite Curve {:} = 4;\n";
  // Lower sides of four segments, all others of three: the boundary of each square is odd.
  script += fmt::format(
      "For k In {{0 : {0}}}\n  c() = Curve In BoundingBox {{-0.1, 2 * k - 0.1, -0.1, {0} + 0.1, 2 * k + 0.1, 0.1}};\n"
      "  Transfinite Curve {{c()}} = 5;\nEndFor\n",
      n);
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", script);
  make_msh(directory / "in.msh", 4.1, false, [&] {
    ::gmsh::merge(directory / "in.geo");
    ::gmsh::model::mesh::generate(2);
  });
  const Outcome outcome = run_all_quad(directory);
  CAPTURE(outcome.err);
  CHECK(outcome.report["all_quad"]["odd_regions"] == n * n);
  CHECK(outcome.report["all_quad"]["splits"].size() == n * n / 2);
  CHECK(outcome.report["total"]["triangles"] == 0);
}
