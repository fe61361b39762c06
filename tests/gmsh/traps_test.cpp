// SPDX-License-Identifier: GPL-2.0-or-later
/// Traps of the Gmsh API that this code has to step around, one test each.

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

#include "gmsh/model/model_mesh.hpp"
#include "gmsh/model/patches.hpp"
#include "gmsh/read/open.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"
#include "qmorph/gmsh.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

constexpr const char* kSquare = R"(SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1};
Mesh.MeshSizeMax = 0.2;
)";

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("trap 1: an error of the mesher does not end the process") {
  const TemporaryDirectory directory;
  write_file(directory / "open.geo",
             "Point(1)={0,0,0,1}; Point(2)={1,0,0,1}; Point(3)={1,1,0,1};\n"
             "Line(1)={1,2}; Line(2)={2,3};\nCurve Loop(1)={1,2};\nPlane Surface(1)={1};\n");
  const Result result = run_qmorph({directory / "open.geo"});
  CHECK(result.status == 2);
  CHECK(mentions(result.err, "closed loop"));
  CHECK(directory.files() == std::vector<std::string>{"open.geo"});
}

TEST_CASE("trap 1: not even if the script turns off what guards against it") {
  const std::string guards = "General.AbortOnError = 2;\nGeneral.Verbosity = 0;\n";
  const TemporaryDirectory directory;
  write_file(directory / "open.geo",
             guards +
                 "Point(1)={0,0,0,1}; Point(2)={1,0,0,1}; Point(3)={1,1,0,1};\n"
                 "Line(1)={1,2}; Line(2)={2,3};\nCurve Loop(1)={1,2};\nPlane Surface(1)={1};\n");
  write_file(directory / "syntax.geo", guards + "Point(1) = {0;\n");
  write_file(directory / "silent.geo", "General.Verbosity = 0;\nPoint(1) = {0;\n");
  for (const std::string name : {"open.geo", "syntax.geo", "silent.geo"}) {
    CAPTURE(name);
    const Result result = run_qmorph({directory / name});
    CAPTURE(result.err);
    CHECK(result.status == 2);
  }
  CHECK(directory.files().size() == 3);
}

TEST_CASE("trap 2: a parse error does not lock the library for the next file") {
  const TemporaryDirectory directory;
  write_file(directory / "bad.geo", "Point(1) = {0,\n");
  write_file(directory / "good.geo", kSquare);
  CHECK(run_qmorph({directory / "bad.geo"}).status == 2);
  CHECK(run_qmorph({directory / "good.geo"}).status == 0);
  // In one session, too, which is how another program would call it.
  const adapter::Session session;
  CHECK_THROWS_AS(adapter::open_model(directory / "bad.geo"), InputError);
  ::gmsh::clear();
  CHECK_NOTHROW(adapter::open_model(directory / "good.geo"));
  CHECK(session::recombine().count(SurfaceOutcome::converted) == 1);
}

TEST_CASE("trap 3: a missing file is an error") {
  const TemporaryDirectory directory;
  const Result result = run_qmorph({directory / "none.msh"});
  CHECK(result.status == 2);
  CHECK(mentions(result.err, "none.msh: no such file"));
  CHECK(directory.files().empty());
}

TEST_CASE("trap 4: exceptions of old and new Gmsh become errors of ours") {
  const adapter::Session session;
  const adapter::StageLog old_kind = adapter::run_logged([] { throw std::string("old"); });
  CHECK(adapter::first_errors(old_kind) == "old");
  const adapter::StageLog new_kind = adapter::run_logged([] { throw std::runtime_error("new"); });
  CHECK(adapter::first_errors(new_kind) == "new");
  CHECK_THROWS_AS(adapter::run_logged([] { throw SurfaceError("ours"); }), SurfaceError);
}

TEST_CASE("trap 5: nodes that another surface uses are not freed with the surface that owns them") {
  // Two surfaces that meet without line elements: the first owns the nodes between them. Only the first is converted.
  const TemporaryDirectory directory;
  const Grid grid;
  std::vector<std::string> elements;
  for (const auto& triangle : grid.triangles())
    elements.push_back(row(triangle[0] % 5 == 1 || triangle[0] % 5 == 2 ? "2 2 0 1" : "2 2 0 2", triangle));
  write_file(directory / "in.msh", msh22(grid.nodes(), elements));
  CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--surfaces", "1"}).status == 0);
  const Snapshot before = read_snapshot(directory / "in.msh"), after = read_snapshot(directory / "out.msh");
  CHECK(difference(before, after, {1}) == "");
  CHECK(element_counts(after, 1).first == 0);
  CHECK(element_counts(after, 2) == element_counts(before, 2));
}

TEST_CASE("trap 6: without removeElements, surfaces with volumes beside them are put back whole") {
  // A box with tetrahedra and, elsewhere, a plate: the plate is converted, the box stays.
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, [] {
    ::gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
    ::gmsh::model::occ::addRectangle(3, 0, 0, 1, 1, 50);
    ::gmsh::model::occ::synchronize();
    adapter::set_option("Mesh.MeshSizeMax", 0.3);
    ::gmsh::model::mesh::generate(3);
  });
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(result.status == 3);
  CHECK(mentions(result.err, "surface 1: "));
  CHECK(mentions(result.err, "bounds volume"));
  const Snapshot before = read_snapshot(directory / "in.msh"), after = read_snapshot(directory / "out.msh");
  CHECK(difference(before, after, {50}) == "");
  CHECK(element_counts(after, 50).first == 0);
}

TEST_CASE("trap 7: clear() refuses a surface of a volume, so it is never asked to") {
  const TemporaryDirectory directory;
  for (const double version : {2.2, 4.1}) {
    CAPTURE(version);
    make_msh(directory / "in.msh", version, false, [] {
      ::gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
      ::gmsh::model::occ::synchronize();
      adapter::set_option("Mesh.MeshSizeMax", 0.5);
      ::gmsh::model::mesh::generate(3);
    });
    const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
    CHECK(result.status == 3);
    CHECK(mentions(result.err, "6 of 6 surfaces left as they were"));
    CHECK((read_file(directory / "in.msh") == read_file(directory / "out.msh")));
  }
}

TEST_CASE("trap 8: embedded curves and points and seams are found although getNodes hides them") {
  const adapter::Session session;
  build_two_squares();
  const adapter::ModelMesh mesh = adapter::read_model_mesh();
  const adapter::NodeUse use = adapter::find_node_use(mesh);
  const adapter::FixedEdges edges(mesh, use);
  std::vector<Index> local(mesh.tags.size(), kNone);
  for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
    if (mesh.entities[e].dim != 2 || mesh.entities[e].tag != 1) continue;
    const adapter::SurfaceMesh surface = adapter::read_surface(mesh, use, edges, e, local);
    REQUIRE(surface.parts.size() == 1);
    const Patch& patch = surface.parts[0].patch;
    // 4 sides of 5 edges and the crack of 2; their 20 + 3 nodes and the probe.
    CHECK(patch.constraints.size() == 22);
    CHECK(patch.fixed.size() == 24);
    CHECK(surface.parts[0].rows.size() == patch.points.size());
  }
  CHECK(std::count(local.begin(), local.end(), kNone) == static_cast<std::ptrdiff_t>(local.size()));
}

TEST_CASE("trap 9: algorithm 8 does not crash") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquare);
  const Result result = run_qmorph({directory / "in.geo", "-algo", "delquad"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  CHECK(element_counts(read_snapshot(directory / "in.msh"), 1).first == 0);
}

TEST_CASE("trap 10: many surfaces are put back in one go") {
  const TemporaryDirectory directory;
  std::string script = "SetFactory(\"OpenCASCADE\");\nMesh.MeshSizeMax = 0.25;\n";
  for (int i = 0; i < 60; ++i)
    script += "Rectangle(" + std::to_string(i + 1) + ") = {" + std::to_string(2 * i) + ", 0, 0, 1, 1};\n";
  write_file(directory / "in.geo", script);
  CHECK(run_qmorph({directory / "in.geo"}).status == 0);
  const Snapshot after = read_snapshot(directory / "in.msh");
  for (int i = 1; i <= 60; ++i) CHECK(element_counts(after, i).second > 0);
}

TEST_CASE("trap 11: several threads do not write to the log at once") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", std::string(kSquare) + "General.NumThreads = 8;\nMesh.MaxNumThreads2D = 8;\n");
  for (int i = 0; i < 3; ++i) CHECK(run_qmorph({directory / "in.geo", "-nt", "8"}).status == 0);
  const adapter::Session session({"-nt", "8"});
  CHECK(adapter::get_option("General.NumThreads") == 1);
  adapter::open_model(directory / "in.geo");
  CHECK(adapter::get_option("General.NumThreads") == 1);
}
