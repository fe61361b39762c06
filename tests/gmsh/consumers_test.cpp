// SPDX-License-Identifier: GPL-2.0-or-later
/// --for: what each reader needs, and what is said when it cannot have it.

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <set>
#include <sstream>
#include <string>

#include "gmsh/session/compat.hpp"
#include "gmsh/support.hpp"

using namespace qmorph::test;

namespace {

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A square with an inner curve "inner", a boundary curve "bottom" and a surface "plate".
std::string square(const std::string& more = {}) {
  return "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\nPoint(10) = {0.3, 0.5, 0};\n"
         "Point(11) = {0.7, 0.5, 0};\nLine(10) = {10, 11};\nCurve{10} In Surface{1};\nMesh.MeshSizeMax = 0.2;\n"
         "Physical Surface(\"plate\", 1) = {1};\nPhysical Curve(\"bottom\", 2) = {1};\n"
         "Physical Curve(\"inner\", 3) = {10};\n" +
         more;
}

std::vector<std::vector<int>> elements_of(const std::string& msh2) {
  std::istringstream in(msh2.substr(msh2.find("$Elements")));
  std::vector<std::vector<int>> elements;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::vector<int> element;
    for (int word; words >> word;) element.push_back(word);
    if (element.size() > 4) elements.push_back(element);
  }
  return elements;
}

struct Run {
  TemporaryDirectory directory;
  Result result;
  std::string text;
  Run(const std::string& reader, const std::string& script, std::vector<std::string> words = {}) {
    const std::string out = directory / (reader == "su2"                              ? "out.su2"
                                         : reader == "calculix" || reader == "abaqus" ? "out.inp"
                                                                                      : "out.msh");
    write_file(directory / "in.geo", script);
    words.insert(words.end(), {directory / "in.geo", "-o", out, "--for", reader});
    result = run_qmorph(words);
    if (result.status == 0) text = read_file(out);
  }
};

}  // namespace

TEST_CASE("consumers: MSH 2.2 in ASCII with numbers from 1, one group for each element") {
  for (const char* reader : {"dealii", "mfem", "dolfinx", "elmer"}) {
    CAPTURE(reader);
    const Run run(reader, square());
    CAPTURE(run.result.err);
    REQUIRE(run.result.status == 0);
    CHECK(run.text.substr(0, 20) == "$MeshFormat\n2.2 0 8\n");
    int number = 0, largest = 0;
    std::set<int> nodes;
    for (const auto& element : elements_of(run.text)) {
      CHECK(element[0] == ++number);
      CHECK(element[2] == 2);
      CHECK(element[3] > 0);
      for (std::size_t i = 5; i < element.size(); ++i) nodes.insert(element[i]);
    }
    largest = *nodes.rbegin();
    CHECK(*nodes.begin() == 1);
    CHECK(nodes.size() == static_cast<std::size_t>(largest));
    CHECK(mentions(run.text, "$Nodes\n" + std::to_string(largest) + "\n"));
  }
}

TEST_CASE("consumers: lines inside are kept for those that take them, and left out for deal.II") {
  const auto count_inner = [](const Run& run) {
    int count = 0;
    for (const auto& element : elements_of(run.text)) count += element[1] == 1 && element[3] == 3;
    return count;
  };
  CHECK(count_inner(Run("dealii", square())) == 0);
  CHECK(count_inner(Run("elmer", square())) > 0);
}

TEST_CASE("consumers: what a reader would refuse is reported in its terms, and nothing is written") {
  const std::string twice = "Physical Surface(\"all\", 9) = {1};\n";
  const std::string none = "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\nMesh.MeshSizeMax = 0.3;\n";
  const struct {
    const char* reader;
    std::string script;
    std::vector<std::string> words;
    const char* message;
  } kCases[] = {
      {"dealii", square(twice), {}, "surface 1 is in 2 physical groups, and deal.II takes one per element"},
      {"dealii", square(), {"-order", "2"}, "the elements are of order 2, and deal.II takes order 1 at most"},
      {"dolfinx", none, {}, "surface 1 is in no physical group, and DOLFINx needs a tag for every cell"},
      {"openfoam", square(), {}, "there are no cells of dimension 3, and gmshToFoam reads no others"},
      {"su2", none, {}, "no curve is in a physical group, so SU2 would have no marker"},
  };
  for (const auto& the_case : kCases) {
    CAPTURE(the_case.message);
    const Run run(the_case.reader, the_case.script, the_case.words);
    CAPTURE(run.result.err);
    CHECK(run.result.status == 6);
    CHECK(mentions(run.result.err, the_case.message));
    CHECK(run.directory.files() == std::vector<std::string>{"in.geo"});
  }
  const Run unknown("fluent", none);
  CHECK(unknown.result.status == 1);
  CHECK(mentions(unknown.result.err, "there is no reader 'fluent' (dealii, mfem, "));
}

TEST_CASE("consumers: a triangle that is left is reported for readers that need quads") {
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", msh22({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {"2 2 1 1 1 2 3"}));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--for", "dealii"});
  CHECK(result.status == 6);
  CHECK(mentions(result.err, "1 triangle is left, and deal.II takes quads only; --all-quad, or"));
}

TEST_CASE("consumers: a deck has plane-stress quads and sets, and no trusses") {
  for (const char* order : {"1", "2"}) {
    CAPTURE(order);
    const Run run("calculix", square(), {"-order", order});
    CAPTURE(run.result.err);
    REQUIRE(run.result.status == 0);
    CHECK(mentions(run.text, std::string("*ELEMENT, TYPE=CPS") + (*order == '1' ? "4" : "8") + ", ELSET=Surface1\n"));
    CHECK(!mentions(run.text, "T3D2"));
    for (const char* set : {"*ELSET, ELSET=plate\n", "*NSET, NSET=bottom\n", "*NSET, NSET=inner\n"})
      CHECK(mentions(run.text, set));
  }
}

TEST_CASE("consumers: clockwise surfaces are turned for readers that want them counterclockwise") {
  const TemporaryDirectory directory;
  write_file(directory / "in.msh",
             msh22({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {"2 2 1 1 1 3 2", "2 2 1 1 1 4 3"}));
  const auto area = [&](const char* reader) {
    REQUIRE(run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--for", reader}).status == 0);
    const Snapshot after = read_snapshot(directory / "out.msh");
    const auto* quads = after.mesh.entities.front().block(qmorph::adapter::kQuad4);
    REQUIRE(quads);
    const auto p = [&](std::size_t i) { return after.mesh.points[after.mesh.rows.find(quads->nodes[i])]; };
    return (p(1) - p(0)).cross(p(2) - p(0)).z();
  };
  CHECK(area("mfem") > 0);
  CHECK(area("elmer") < 0);
}

TEST_CASE("consumers: SPECFEM2D's converter gets lines first, and the names that it looks for") {
  const std::string named =
      "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\nMesh.MeshSizeMax = 0.2;\n"
      "Physical Surface(\"M1\", 11) = {1}; Physical Curve(\"Bottom\", 12) = {1}; Physical Curve(\"Right\", 13) = {2};\n"
      "Physical Curve(\"Top\", 14) = {3}; Physical Curve(\"Left\", 15) = {4}; Physical Point(\"source\", 16) = {1};\n";
  for (const char* order : {"1", "2"}) {
    const Run run("specfem2d", named, {"-order", order});
    CAPTURE(run.result.err);
    REQUIRE(run.result.status == 0);
    CHECK(elements_of(run.text).front()[1] == (*order == '1' ? 1 : 8));
  }
  const Run unnamed("specfem2d", square());
  CHECK(unnamed.result.status == 6);
  CHECK(mentions(unnamed.result.err,
                 "needs physical curves Top, Bottom, Left and Right, and there is no Bottom, Left, Right, Top"));
  CHECK(mentions(unnamed.result.err, "needs physical surfaces to be named M1, M2, ..., and there is 1 \"plate\""));
}

TEST_CASE("consumers: elements of two orders are refused") {
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", msh22({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {3, 0, 0}, {5, 0, 0}, {4, 0, 0}},
                                         {"2 2 1 1 1 2 3", "2 2 1 1 1 3 4", "8 2 2 1 5 6 7"}));
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--for", "mfem"});
  CHECK(result.status == 6);
  CHECK(mentions(result.err, "the elements are of orders 1 and 2, and MFEM takes only one order in a file"));
}

TEST_CASE("consumers: the family of a deck's elements") {
  const struct {
    std::vector<std::string> words;
    const char* type;
  } kCases[] = {{{"--elements", "CPE"}, "TYPE=CPE4,"},
                {{"--elements", "S", "-order", "2"}, "TYPE=S8,"},
                {{"--elements=CPSR"}, "TYPE=CPS4R,"}};
  for (const auto& the_case : kCases) {
    CAPTURE(the_case.type);
    const Run run("abaqus", square(), the_case.words);
    CAPTURE(run.result.err);
    CHECK(run.result.status == 0);
    CHECK(mentions(run.text, the_case.type));
  }
  CHECK(Run("abaqus", square(), {"--elements", "C3D"}).result.status == 1);
  CHECK(Run("mfem", square(), {"--elements", "CPE"}).result.status == 1);
}

/// A quarter of a cylinder's wall, and the square at this height.
const char* const kWall =
    "SetFactory(\"OpenCASCADE\");\nCircle(1) = {0, 0, 0, 1, 0, Pi / 2};\nExtrude {0, 0, 1} { Curve{1}; }\n"
    "Mesh.MeshSizeMax = 0.3;\nPhysical Surface(\"wall\", 1) = {1};\nPhysical Curve(\"rim\", 2) = {1};\n";
std::string at_height(const std::string& z) {
  return "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, " + z +
         ", 1, 1};\nMesh.MeshSizeMax = 0.2;\nPhysical Surface(\"plate\", 1) = {1};\n"
         "Physical Curve(\"bottom\", 2) = {1};\n";
}

TEST_CASE("consumers: surfaces that are not in the plane z = 0 are shells in a deck") {
  const struct {
    std::string script;
    const char *order, *type;
  } kCases[] = {
      {kWall, "1", "S4"}, {kWall, "2", "S8"}, {at_height("0.5"), "1", "S4"}, {at_height("1e-15"), "1", "CPS4"}};
  for (const auto& the_case : kCases)
    for (const char* reader : {"calculix", "abaqus"}) {
      CAPTURE(the_case.type);
      const Run run(reader, the_case.script, {"-order", the_case.order});
      CAPTURE(run.result.err);
      REQUIRE(run.result.status == 0);
      CHECK(mentions(run.text, std::string("*ELEMENT, TYPE=") + the_case.type + ","));
    }
  CHECK(!mentions(Run("calculix", at_height("1e-15")).text, "e-1"));
  for (const char* family : {"CPS", "CPER", "CAX"}) {
    const Run run("calculix", kWall, {"--elements", family});
    CHECK(run.result.status == 6);
    CHECK(mentions(run.result.err,
                   std::string("elements ") + family + " must lie in the plane z = 0, and this mesh has a node at ("));
    CHECK(mentions(run.result.err, "--elements S makes shells"));
  }
}

TEST_CASE("consumers: triangles that are left are shells like their neighbours") {
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", msh22({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.2}, {0, 1, 0.2}, {0, 2, 0}},
                                         {"2 2 1 1 1 2 3", "2 2 1 1 1 3 4", "2 2 1 1 4 3 5"}));
  for (const char* order : {"1", "2"}) {
    const Result result =
        run_qmorph({directory / "in.msh", "-order", order, "-o", directory / "out.inp", "--for", "calculix"});
    CAPTURE(result.err);
    REQUIRE(result.status == 0);
    const std::string text = read_file(directory / "out.inp");
    CHECK(mentions(text, *order == '1' ? "TYPE=S3," : "TYPE=S6,"));
    CHECK(mentions(text, *order == '1' ? "TYPE=S4," : "TYPE=S8,"));
  }
}

TEST_CASE("consumers: Gmsh's own decks have shells in space, too") {
  const TemporaryDirectory directory;
  write_file(directory / "wall.geo", kWall);
  write_file(directory / "flat.geo", square());
  for (const char* order : {"1", "2"}) {
    REQUIRE(run_qmorph({"-2", directory / "wall.geo", "-order", order, "-o", directory / "out.inp"}).status == 0);
    const std::string shells = read_file(directory / "out.inp");
    CHECK(mentions(shells, std::string("*ELEMENT, type=S") + (*order == '1' ? "4," : "8,")));
    CHECK(!mentions(shells, "CPS"));
    REQUIRE(run_qmorph({"-2", directory / "flat.geo", "-order", order, "-o", directory / "out.inp"}).status == 0);
    CHECK(mentions(read_file(directory / "out.inp"), std::string("type=CPS") + (*order == '1' ? "4," : "8,")));
  }
}

TEST_CASE("consumers: for readers of planar meshes others are refused, in the reader's terms") {
  const Run su2("su2", kWall);
  CHECK(su2.result.status == 6);
  CHECK(mentions(su2.result.err, "SU2 takes surfaces only in a plane z = constant, and this mesh has nodes at ("));
  CHECK(su2.directory.files() == std::vector<std::string>{"in.geo"});
  CHECK(mentions(Run("specfem2d", kWall).result.err, "SPECFEM2D takes surfaces only in a plane z = constant"));
  CHECK(Run("su2", at_height("0.5")).result.status == 0);
  for (const char* reader : {"dealii", "mfem", "dolfinx", "elmer"}) CHECK(Run(reader, kWall).result.status == 0);
}

TEST_CASE("consumers: SU2 gets markers, counterclockwise quads and numbers from 0") {
  const Run run("su2", square());
  CAPTURE(run.result.err);
  REQUIRE(run.result.status == 0);
  CHECK(run.text.substr(0, 9) == "NDIME= 2\n");
  CHECK(mentions(run.text, "\nNMARK= 1\nMARKER_TAG= bottom\nMARKER_ELEMS= "));
  std::istringstream in(run.text.substr(run.text.find("NELEM= ") + 7));
  std::size_t count = 0;
  in >> count;
  CHECK(count > 10);
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t type = 0, a = 0, b = 0, c = 0, d = 0, number = 0;
    in >> type >> a >> b >> c >> d >> number;
    CHECK(type == 9);
    CHECK(number == i);
  }
}
