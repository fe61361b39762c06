// SPDX-License-Identifier: GPL-2.0-or-later
/// What people write after gmsh in their Makefiles.

#include "cli/request/gmsh_options.hpp"

#include <doctest/doctest.h>

#include <sstream>
#include <string>
#include <vector>

#include "cli/request/request.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"
#include "qmorph/error.hpp"

using namespace qmorph;
using namespace qmorph::test;
using Words = std::vector<std::string>;

namespace {

constexpr const char* kSquare = "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\n";

Words split(const std::string& text) {
  std::istringstream in(text);
  Words words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::size_t count_quads(const std::string& path) { return element_counts(read_snapshot(path), 1).second; }

}  // namespace

TEST_CASE("gmsh options: lines of Makefiles work") {
  // From Gmsh's manual, its tutorials and public repositories, with gmsh replaced.
  const char* const kLines[] = {
      "-2 in.geo",
      "in.geo -2 -o out.msh",
      "-2 -format msh2 -o out.msh in.geo",
      "in.geo -2 -clmax 0.3 -clmin 0.1 -algo del2d",
      "-2 in.geo -order 2 -optimize_ho",
      "-2 -clscale 0.5 -bin in.geo",
      "in.geo -nopopup -2 -v 0",
      "-2 in.geo -save_all -setnumber Mesh.SaveParametric 0 -nt 2",
      "in.geo -2 -part 2 -part_topo",
      "-string Mesh.MeshSizeMax=0.3; in.geo -2 -f msh22",
      "in.geo -2 -smooth 5 -clcurv 12 -clextend 1 -rand 1e-8",
      "in.geo -2 -quad -tol 1e-7 -noenv -cpu",
      "-2 in.geo -setlist sizes 2 0.1 0.2 -setstring name value",
  };
  for (const char* line : kLines) {
    CAPTURE(line);
    const TemporaryDirectory directory;
    write_file(directory / "in.geo", kSquare);
    Words words = split(line);
    for (std::string& word : words)
      if (word == "in.geo" || word == "out.msh") word = directory / word;
    const Result result = run_qmorph(words);
    CAPTURE(result.err);
    CHECK(result.status == 0);
  }
}

TEST_CASE("gmsh options: the library knows every option that is passed on") {
  // It ends the process on others, which would be seen.
  std::istringstream names(cli::passed_gmsh_options());
  Words arguments;
  for (std::string name; names >> name;) {
    const cli::GmshOptionRow* row = cli::find_gmsh_option(name.substr(1));
    REQUIRE(row);
    arguments.push_back(name);
    if (name == "-algo") arguments.push_back("front2d");
    if (name == "-bgm") arguments.push_back("sizes.pos");
    if (name == "-option") arguments.push_back("/dev/null");
    if (name == "-string") arguments.push_back("a = 1;");
    if (name == "-setstring") arguments.insert(arguments.end(), {"name", "value"});
    if (name == "-setlist") arguments.insert(arguments.end(), {"list", "1", "3"});
    if (name == "-setnumber") arguments.insert(arguments.end(), {"number", "1"});
    if (row->note == "number" || row->note == "positive") arguments.push_back("1");
  }
  const adapter::Session session(arguments);
  CHECK(adapter::get_option("Mesh.SaveAll") == 1);
}

TEST_CASE("gmsh options: strings and option files set sizes, and so does a file beside the input") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquare);
  write_file(directory / "fine.opt", "Mesh.MeshSizeMax = 0.05;\n");
  REQUIRE(run_qmorph({directory / "in.geo"}).status == 0);
  const std::size_t coarse = count_quads(directory / "in.msh");
  for (const Words& words : {Words{"-option", directory / "fine.opt"}, Words{"-string", "Mesh.MeshSizeMax = 0.05;"}}) {
    CAPTURE(words);
    Words all = words;
    all.push_back(directory / "in.geo");
    REQUIRE(run_qmorph(all).status == 0);
    CHECK(count_quads(directory / "in.msh") > 2 * coarse);
  }
  write_file(directory / "in.geo.opt", "Mesh.MeshSizeMax = 0.05;\n");
  REQUIRE(run_qmorph({directory / "in.geo"}).status == 0);
  CHECK(count_quads(directory / "in.msh") > 2 * coarse);
}

TEST_CASE("gmsh options: what asks for something else is refused by name") {
  for (const char* option : {"-0", "-1", "-refine", "-check", "-part_split", "-parse_and_exit", "-convert",
                             "-reclassify", "-new", "-log", "-watch"}) {
    CAPTURE(option);
    const Result result = run_qmorph({option, "1", "in.geo"});
    CHECK(result.status == 1);
    CHECK(result.err.find(std::string("qmorph: ") + option + ": not here; ") == 0);
  }
}

TEST_CASE("gmsh options: further files are merged") {
  const TemporaryDirectory directory;
  write_file(directory / "a.geo", kSquare);
  write_file(directory / "b.geo", "SetFactory(\"OpenCASCADE\");\nRectangle(2) = {3, 0, 0, 1, 1};\n");
  const Result result = run_qmorph({directory / "a.geo", directory / "b.geo", "-o", directory / "out.msh"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  const Snapshot after = read_snapshot(directory / "out.msh");
  for (int surface : {1, 2}) CHECK(element_counts(after, surface).second > 0);
  CHECK(run_qmorph({directory / "a.geo", directory / "none.geo"}).status == 2);
}

TEST_CASE("gmsh options: -save meshes nothing, and -meshscale scales what is written") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquare);
  CHECK(run_qmorph({directory / "in.geo", "-save"}).status == 4);
  for (const char* format : {"msh22", "msh41"}) {
    make_msh(directory / "in.msh", 2.2, false, build_two_squares);
    CHECK(
        run_qmorph({directory / "in.msh", "-meshscale", "10", "-format", format, "-o", directory / "out.msh"}).status ==
        0);
    double largest = 0;
    for (const auto& p : read_snapshot(directory / "out.msh").mesh.points) largest = std::max(largest, p.x());
    CHECK(largest == doctest::Approx(10));
  }
}

TEST_CASE("gmsh options: -bgm takes sizes from a view") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquare);
  write_file(directory / "sizes.pos", "View \"sizes\" { SQ(0,0,0, 1,0,0, 1,1,0, 0,1,0){0.05,0.05,0.05,0.05}; };\n");
  write_file(directory / "none.pos", "a = 1;\n");
  REQUIRE(run_qmorph({directory / "in.geo"}).status == 0);
  const std::size_t coarse = count_quads(directory / "in.msh");
  const Result result = run_qmorph({directory / "in.geo", "-2", "-bgm", directory / "sizes.pos"});
  CAPTURE(result.err);
  REQUIRE(result.status == 0);
  CHECK(count_quads(directory / "in.msh") > 2 * coarse);
  CHECK(run_qmorph({directory / "in.geo", "-bgm", directory / "none.pos"}).status == 2);
  CHECK(run_qmorph({directory / "in.geo", "-bgm", directory / "missing.pos"}).status == 2);
}

TEST_CASE("gmsh options: - beside a file is refused by name") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquare);
  const Result result = run_qmorph({directory / "in.geo", "-"});
  CHECK(result.status == 1);
  CHECK(result.err.find("qmorph: -: ") == 0);
}

TEST_CASE("gmsh options: - is the standard output, with nothing else on it") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquare);
  const Result result = run_qmorph({directory / "in.geo", "-o", "-", "-format", "msh2"});
  CAPTURE(result.err);
  CHECK(result.status == 0);
  CHECK(result.out.substr(0, 20) == "$MeshFormat\n2.2 0 8\n");
  CHECK(result.out.substr(result.out.size() - 13) == "$EndElements\n");
  CHECK(directory.files() == std::vector<std::string>{"in.geo"});
}

TEST_CASE("gmsh options: with - there can be no file of views beside the mesh") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquare);
  const Result refused = run_qmorph({directory / "in.geo", "-o", "-", "-format", "vtk", "--views"});
  CHECK(refused.status == 1);
  CHECK(refused.err.find("qmorph: --views: the standard output has no file beside it") == 0);
  CHECK(refused.out.empty());
  const Result taken = run_qmorph({directory / "in.geo", "-o", "-", "--views"});
  CHECK(taken.status == 0);
  CHECK(taken.out.find("$ElementData") != std::string::npos);
}
