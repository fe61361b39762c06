// SPDX-License-Identifier: GPL-2.0-or-later
/// Every kind of bad input: its message, its exit status, and no file touched (I9).

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "gmsh/support.hpp"

using namespace qmorph::test;

namespace {

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

constexpr const char* kSquare =
    "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\nMesh.MeshSizeMax = 0.3;\n";

/// A directory with an input and an earlier output, both of which must survive.
struct Scene {
  TemporaryDirectory directory;
  std::string input, output = directory / "out.msh";
  explicit Scene(const std::string& name, const std::string& text) : input(directory / name) {
    write_file(input, text);
    write_file(output, "earlier");
    text_ = text;
  }
  void expect(const Result& result, int status, const std::string& message) {
    CAPTURE(result.err);
    CHECK(result.status == status);
    CHECK(mentions(result.err, message));
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    CHECK(result.out.empty());
    CHECK((read_file(input) == text_));
    CHECK(read_file(output) == "earlier");
    CHECK(directory.files().size() == 2);
  }

 private:
  std::string text_;
};

std::string grid_text() {
  const Grid grid;
  std::vector<std::string> elements;
  for (const auto& triangle : grid.triangles()) elements.push_back(row("2 2 0 1", triangle));
  return msh22(grid.nodes(), elements);
}

}  // namespace

TEST_CASE("status 1: usage, before anything is opened") {
  Scene scene("in.geo", kSquare);
  scene.expect(run_qmorph({scene.input, "-o", scene.output, "-foo"}), 1, "qmorph: unknown option '-foo'");
  scene.expect(run_qmorph({scene.input, "-o", scene.output, "-format", "foo"}), 1, "unknown format 'foo'");
  scene.expect(run_qmorph({scene.input, "-o", scene.output, "--smoothing", "x"}), 1, "neither shape_energy nor thesis");
  scene.expect(run_qmorph({scene.input, "-o", scene.output, "--set", "NO=1"}), 1, "--set: there is no option 'NO'");
  scene.expect(run_qmorph({scene.input, "-o", scene.output, "--set", "cleanup.shape_angle=x"}), 1, "takes NAME=NUMBER");
  scene.expect(run_qmorph({scene.input, "-o", scene.output, "--set", "cleanup.shape_angle=1e9"}), 1, "out of range");
  scene.expect(run_qmorph({scene.input, "-o", scene.output, "--surfaces", "9"}), 1, "the model has no surface 9");
}

TEST_CASE("status 1: figures in the place of the mesh, by whatever name") {
  Scene scene("in.geo", kSquare);
  const std::string detour = scene.directory / "./in.geo";
  scene.expect(run_qmorph({scene.input, "-o", scene.output, "--stats", scene.output}), 1, "is the output");
  scene.expect(run_qmorph({scene.input, "-o", scene.output, "--stats", scene.input}), 1, "is the input");
  scene.expect(run_qmorph({scene.input, "-o", scene.output, "--stats", detour}), 1, "is the input");
  scene.expect(run_qmorph({scene.input, "--stats", scene.directory / "./in.msh"}), 1, "is the output");
  scene.expect(run_qmorph({scene.input, "-o", scene.output, "--stats", "-"}), 1, "only the mesh goes to the standard");
}

TEST_CASE("status 2: inputs that cannot be read") {
  const struct {
    const char *name, *text, *message;
  } kCases[] = {
      {"empty.msh", "", "is empty"},
      {"empty.geo", "", "is empty"},
      {"garbage.msh", "garbage\n", "it is not a Gmsh mesh"},
      {"version.msh", "$MeshFormat\n9.9 0 8\n$EndMeshFormat\n", "cannot be opened"},
      {"syntax.geo", "Point(1) = {0;\n", "syntax error"},
      {"error.geo", "Error(\"boo\");\n", "boo"},
      {"include.geo", "Include \"nothing.geo\";\n", "nothing.geo"},
      {"garbage.step", "garbage\n", "cannot be opened"},
      {"loop.geo",
       "Point(1)={0,0,0,1}; Point(2)={1,0,0,1}; Point(3)={1,1,0,1};\nLine(1)={1,2}; Line(2)={2,3};\n"
       "Curve Loop(1)={1,2};\nPlane Surface(1)={1};\n",
       "cannot mesh"},
      {"bow.geo",
       "Point(1)={0,0,0,1}; Point(2)={1,1,0,1}; Point(3)={1,0,0,1}; Point(4)={0,1,0,1};\nLine(1)={1,2}; "
       "Line(2)={2,3};\n"
       "Line(3)={3,4}; Line(4)={4,1};\nCurve Loop(1)={1,2,3,4};\nPlane Surface(1)={1};\n",
       "cannot mesh"},
  };
  for (const auto& the_case : kCases) {
    CAPTURE(the_case.name);
    Scene scene(the_case.name, the_case.text);
    scene.expect(run_qmorph({scene.input, "-o", scene.output}), 2, the_case.message);
  }
}

TEST_CASE("status 2: a truncated mesh, wherever it ends") {
  const std::string text = grid_text();
  const std::size_t nodes_end = text.find("$EndNodes");
  for (std::size_t length = 60; length < text.rfind("$EndElements") + 4; length += 7) {
    if (length >= nodes_end + 4 && length < nodes_end + 12) continue;  // a whole file without elements
    CAPTURE(length);
    Scene scene("in.msh", text.substr(0, length));
    scene.expect(run_qmorph({scene.input, "-o", scene.output}), 2, "qmorph: ");
  }
}

TEST_CASE("status 2: a mesh that contradicts itself, of which Gmsh would read a part") {
  const std::string whole = grid_text();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
  };
  const struct {
    std::string text, message;
  } kCases[] = {
      {whole.substr(0, whole.find("$Elements")), "has no $Elements: it is not complete, or Gmsh has left out what"},
      {with("$Elements\n32\n", "$Elements\n30\n"), "$Elements says 30, and there are 32"},
      {with("$Elements\n32\n", "$Elements\n-1\n"), "$Elements says -1, and there are 32"},
      {with("2.2 0 8", "2.2 1 8"), "says that it is binary and is not"},
      {with("\n2 2 2 0 1 ", "\n1 2 2 0 1 "), "has 32 elements, and only 31 numbers for them"},
      {with("\n1 2 2 0 1 ", "\n1 999 2 0 1 "), "elements of type 999"},
      {with(" 2 2 0 1 ", " 2 2 0 -1 "), "has the elementary tag -1"},
      {with("$Nodes\n25\n1 ", "$Nodes\n25\n2147483648 "), "node numbers up to 2147483648 leave no room"},
      {"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 1 2147483648 2147483648\n2 1 0 1\n2147483648\n0 0 0\n"
       "$EndNodes\n$Elements\n0 0 0 0\n$EndElements\n",
       "leave no room"},
  };
  for (const auto& the_case : kCases) {
    CAPTURE(the_case.message);
    Scene scene("in.msh", the_case.text);
    scene.expect(run_qmorph({scene.input, "-o", scene.output}), 2, the_case.message);
  }
}

TEST_CASE("status 2: not there, a directory, not readable") {
  Scene scene("in.geo", kSquare);
  scene.expect(run_qmorph({scene.directory / "none.geo", "-o", scene.output}), 2, "none.geo: no such file");
  scene.expect(run_qmorph({"/", "-o", scene.output}), 2, "is a directory");
  if (::geteuid() == 0) return;  // root reads everything
  ::chmod(scene.input.c_str(), 0);
  const Result result = run_qmorph({scene.input, "-o", scene.output});
  ::chmod(scene.input.c_str(), 0644);
  scene.expect(result, 2, "cannot be read");
}

TEST_CASE("status 4: no surfaces") {
  Scene scene("in.geo", "Point(1) = {0, 0, 0, 1};\n");
  scene.expect(run_qmorph({scene.input, "-o", scene.output}), 4, "nothing to convert");
}

TEST_CASE("status 5: impossible places and formats") {
  Scene scene("in.geo", kSquare);
  scene.expect(run_qmorph({scene.input, "-o", "/no/such/directory/out.msh"}), 5,
               "there is no directory /no/such/directory");
  scene.expect(run_qmorph({scene.input, "-o", scene.directory / "out.xyz"}), 5, "unknown extension '.xyz'");
  scene.expect(run_qmorph({scene.input, "-o", scene.directory / "out"}), 5, "unknown extension ''");
  scene.expect(run_qmorph({scene.input, "-o", scene.directory / "out.stl"}), 5, "the format stl cannot hold quads");
  scene.expect(run_qmorph({scene.input, "-format", "msh", "-o", "/dev/null"}), 5, "it is not a regular file");
  scene.expect(run_qmorph({scene.input, "-format", "msh", "-o", "/"}), 5, "it is a directory");
  scene.expect(run_qmorph({scene.input, "-o", scene.output, "--stats", "/no/such/directory/s.json"}), 5,
               "cannot write /no/such/directory/s.json");
}

TEST_CASE("status 5: a format that this Gmsh lacks is reported before anything is opened") {
  Scene scene("in.geo", "Error(\"opened\");\n");
  scene.expect(run_qmorph({scene.input, "-o", scene.output, "-format", "med"}), 5, "this Gmsh has no format med");
}

TEST_CASE("status 5: links that lead back to themselves") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquare);
  std::filesystem::create_symlink("b.msh", directory / "a.msh");
  std::filesystem::create_symlink("a.msh", directory / "b.msh");
  const Result result = run_qmorph({directory / "in.geo", "-o", directory / "a.msh"});
  CHECK(result.status == 5);
  CHECK(mentions(result.err, "its links lead back to themselves"));
  CHECK(std::filesystem::is_symlink(directory / "a.msh"));
}

TEST_CASE("a link to a file that does not exist yet creates the file") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquare);
  std::filesystem::create_symlink("real.msh", directory / "link.msh");
  CHECK(run_qmorph({directory / "in.geo", "-o", directory / "link.msh"}).status == 0);
  CHECK(std::filesystem::is_symlink(directory / "link.msh"));
  CHECK(directory.files() == std::vector<std::string>{"in.geo", "link.msh", "real.msh"});
}

TEST_CASE("status 5: a directory where nobody may write") {
  const Scene scene("in.geo", kSquare);
  // Root may write everywhere but where the kernel makes the files.
  const std::string place = ::geteuid() == 0 ? "/proc/out.msh" : "/out.msh";
  const Result result = run_qmorph({scene.input, "-o", place});
  CAPTURE(result.err);
  CHECK(result.status == 5);
  CHECK(mentions(result.err, "cannot write " + place));
}

TEST_CASE("a link stays a link, and the mode of the file stays") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquare);
  write_file(directory / "real.msh", "earlier");
  ::chmod((directory / "real.msh").c_str(), 0640);
  std::filesystem::create_symlink(directory / "real.msh", directory / "link.msh");
  CHECK(run_qmorph({directory / "in.geo", "-o", directory / "link.msh"}).status == 0);
  CHECK(std::filesystem::is_symlink(directory / "link.msh"));
  CHECK(read_file(directory / "real.msh").substr(0, 11) == "$MeshFormat");
  struct stat status {};
  ::stat((directory / "real.msh").c_str(), &status);
  CHECK((status.st_mode & 0777) == 0640);
}

TEST_CASE("without -o the name is Gmsh's: beside the input, with the extension of the format") {
  const TemporaryDirectory directory;
  write_file(directory / "a.b.geo", kSquare);
  CHECK(run_qmorph({directory / "a.b.geo"}).status == 0);
  CHECK(run_qmorph({directory / "a.b.geo", "-format", "inp"}).status == 0);
  CHECK(run_qmorph({directory / "a.b.geo", "-format", "msh22"}).status == 0);
  CHECK(directory.files() == std::vector<std::string>{"a.b.geo", "a.b.inp", "a.b.msh"});
}

TEST_CASE("verbosity: silent at 0, a line for each surface and a total otherwise") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquare);
  const Result silent = run_qmorph({directory / "in.geo", "-v", "0"});
  CHECK(silent.status == 0);
  CHECK(silent.err.empty());
  const Result spoken = run_qmorph({directory / "in.geo", "-v", "1"});
  CHECK(std::count(spoken.err.begin(), spoken.err.end(), '\n') == 2);
  CHECK(mentions(spoken.err, "surface 1: "));
  CHECK(mentions(spoken.err, " triangles -> "));
  CHECK(mentions(spoken.err, "total: "));
  CHECK(mentions(spoken.err, "scaled Jacobian min "));
  CHECK(spoken.out.empty());
}

TEST_CASE("--help and --version answer on stdout") {
  const Result help = run_qmorph({"--help"});
  CHECK(help.status == 0);
  CHECK(mentions(help.out, "Exit status:"));
  CHECK(help.err.empty());
  const Result version = run_qmorph({"--version"});
  CHECK(version.status == 0);
  CHECK(version.out.substr(0, 7) == "qmorph ");
}
