// SPDX-License-Identifier: GPL-2.0-or-later
/// The same input and options give the same bytes, in every format, on one thread and on two.

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "gmsh/support.hpp"

using namespace qmorph::test;

namespace {

using Words = std::vector<std::string>;

constexpr const char* kStrips =
    "h = 0.3;\nPoint(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {2, 0, 0, h};\n"
    "Point(4) = {2, 1, 0, h}; Point(5) = {1, 1, 0, h}; Point(6) = {0, 1, 0, h};\n"
    "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};\n"
    "Line(7) = {2, 5};\nCurve Loop(1) = {1, 7, 5, 6}; Plane Surface(1) = {1};\n"
    "Curve Loop(2) = {-2, 7, -4, -3}; Plane Surface(2) = {2};\n"
    "Physical Surface(\"all\", 1) = {1, 2};\nPhysical Curve(\"Left\", 2) = {6};\nPhysical Curve(\"Right\", 3) = {3};\n"
    "Physical Curve(\"Bottom\", 4) = {1, 2};\nPhysical Curve(\"Top\", 5) = {4, 5};\n";

constexpr const char* kDisk =
    "SetFactory(\"OpenCASCADE\");\nDisk(1) = {0, 0, 0, 1};\nMesh.MeshSizeMax = 0.4;\nPhysical Surface(\"disk\", 3) = "
    "{1};\n"
    "Physical Curve(\"rim\", 4) = {1};\n";

/// An eighth of a ball.
constexpr const char* kBall =
    "SetFactory(\"OpenCASCADE\");\nSphere(1) = {0, 0, 0, 1, 0, Pi/2, Pi/2};\nMesh.MeshSizeMax = 0.4;\n"
    "Physical Volume(\"ball\", 1) = {1};\nPhysical Surface(\"skin\", 2) = {1:4};\n";

const Words kFormats = {"msh1", "msh2", "msh3", "msh40", "msh41", "unv", "vtk", "mesh",
                        "bdf",  "diff", "ir3",  "inp",   "su2",   "dat", "m",   "key"};

/// Two directories with the same inputs.
class Twins {
 public:
  Twins() {
    for (const TemporaryDirectory* directory : {&first_, &second_}) {
      write_file(*directory / "strips.geo", kStrips);
      write_file(*directory / "disk.geo", kDisk);
      write_file(*directory / "ball.geo", kBall);
      // One elementary tag in two groups: read through a temporary file.
      const Grid grid;
      Words elements;
      for (const auto& triangle : grid.triangles())
        elements.push_back(row(elements.size() % 4 < 2 ? "2 2 5 1" : "2 2 6 1", triangle));
      write_file(*directory / "mixed.msh", msh22(grid.nodes(), elements));
    }
  }

  /// Runs a call in both, and compares the files that it makes, whose names begin with "out".
  void check(const Words& words) const {
    std::string all;
    for (const std::string& word : words) all += word + ' ';
    CAPTURE(all);
    const int status = run(first_, words, "1");
    CHECK(run(second_, words, "2") == status);
    CHECK(first_.files() == second_.files());
    for (const std::string& name : first_.files()) {
      if (name.compare(0, 3, "out") != 0) continue;
      CAPTURE(name);
      const std::string text = read_file(first_ / name);
      CHECK((without_times(text) == without_times(read_file(second_ / name))));
      CHECK(text.find("qmorph-") == std::string::npos);
      std::filesystem::remove(first_ / name);
      std::filesystem::remove(second_ / name);
    }
  }

 private:
  static int run(const TemporaryDirectory& directory, Words words, const char* threads) {
    words.insert(words.end(), {"-v", "0"});
    if (words[1] != "--report") words.insert(words.end(), {"-nt", threads});  // it shows the words
    // Gmsh makes pyramids in one session of a process only.
    if (std::count(words.begin(), words.end(), "-3"))
      return std::system(
          fmt::format("cd '{}' && '{}' {} 2>stderr", directory / ".", QMORPH_COMMAND, fmt::join(words, " ")).c_str());
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(directory / ".");
    const Result result = run_qmorph(words);
    std::filesystem::current_path(before);
    return result.status;
  }

  /// Figures and pages tell how long it took.
  static std::string without_times(const std::string& text) {
    static const std::regex times(R"("\w*seconds":\s*(\{[^}]*\}|[0-9.e+-]+))");
    return text.find("seconds\"") == std::string::npos ? text : std::regex_replace(text, times, "");
  }

  TemporaryDirectory first_, second_;
};

/// This call, with the words behind it.
Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

TEST_CASE("same bytes: every format, with what changes elements") {
  const Twins twins;
  const std::vector<Words> options = {{}, {"-bin"}, {"-order", "2"}, {"-part", "2"}};
  for (const std::string input : {"strips.geo", "disk.geo", "mixed.msh"})
    for (const std::string& format : kFormats)
      for (const Words& words : options) twins.check(with({input, "-o", "out." + format}, words));
}

TEST_CASE("same bytes: every option of the conversion") {
  const Twins twins;
  const std::vector<Words> options = {{"--all-quad"},     {"--cleanup-only"},        {"--orient"},
                                      {"-save_all"},      {"--smoothing", "thesis"}, {"--layers", "off"},
                                      {"--crease", "20"}, {"--drop-volumes"},        {"-3"}};
  for (const std::string input : {"strips.geo", "mixed.msh", "ball.geo"})
    for (const Words& words : options) twins.check(with({input, "-o", "out.msh"}, words));
}

TEST_CASE("same bytes: for every reader") {
  const Twins twins;
  for (const std::string reader : {"dealii", "mfem", "dolfinx", "elmer", "su2", "calculix", "abaqus", "specfem2d"})
    for (const std::string input : {"strips.geo", "mixed.msh"}) twins.check({input, "-o", "out", "--for", reader});
  twins.check({"ball.geo", "-3", "-o", "out", "--for", "openfoam"});
}

TEST_CASE("same bytes: everything beside the mesh") {
  const Twins twins;
  for (const std::string input : {"strips.geo", "mixed.msh", "ball.geo"}) {
    twins.check({input, "-o", "out.msh", "--views", "--svg", "out.svg", "--pdf", "out.pdf", "--tikz", "out.tex",
                 "--depfile", "out.d"});
    twins.check({input, "-o", "out.vtk", "--views", "--svg", "out.svg", "--stage", "front"});
    twins.check({input, "--report", "out.html", "--stats", "out.json", "--film", "out.film", "-o", "out.msh"});
  }
}
