// SPDX-License-Identifier: GPL-2.0-or-later
/// --svg, --pdf, --tikz, --views, --view.

#include <doctest/doctest.h>
#include <gmsh.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

/// Number of times that `part` is in `text`.
std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// What Gmsh reads: the views' names and how many elements or nodes each has a value for; and the smallest value of the
/// first.
struct ReadViews {
  std::vector<std::pair<std::string, std::size_t>> counts;
  double least = 0;
};
ReadViews read_views(const std::string& path) {
  const adapter::Session session;
  ::gmsh::merge(path);
  std::vector<int> tags;
  ::gmsh::view::getTags(tags);
  ReadViews views;
  for (int tag : tags) {
    std::string name, type;
    ::gmsh::option::getString("View[" + std::to_string(::gmsh::view::getIndex(tag)) + "].Name", name);
    std::vector<std::size_t> elements;
    std::vector<std::vector<double>> data;
    double time = 0;
    int components = 0;
    ::gmsh::view::getModelData(tag, 0, type, elements, data, time, components);
    if (views.counts.empty())
      views.least = (*std::min_element(data.begin(), data.end(), [](auto& a, auto& b) { return a[0] < b[0]; }))[0];
    views.counts.emplace_back(name, elements.size());
  }
  return views;
}

}  // namespace

TEST_CASE("pictures: all formats in one call, of the final mesh") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  REQUIRE(run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--svg", directory / "a.svg", "--pdf",
                      directory / "a.pdf", "--tikz", directory / "a.tex"})
              .status == 0);
  const Snapshot after = read_snapshot(directory / "out.msh");
  const std::size_t quads = element_counts(after, 1).second + element_counts(after, 2).second;
  const std::string svg = read_file(directory / "a.svg"), tikz = read_file(directory / "a.tex");
  CHECK(count_of(svg.substr(0, svg.find("fill=\"#101010\"")), "z") >= quads);
  CHECK(count_of(tikz, "--cycle") >= quads);
  CHECK(read_file(directory / "a.pdf").rfind("%PDF", 0) == 0);
}

TEST_CASE("pictures: a stage is shown as it was") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  const auto picture = [&](const std::string& stage) {
    REQUIRE(run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--tikz", directory / "a.tex", "--stage",
                        stage, "--colour", "none"})
                .status == 0);
    return read_file(directory / "a.tex");
  };
  const Snapshot before = read_snapshot(directory / "in.msh");
  const std::size_t triangles = element_counts(before, 1).first + element_counts(before, 2).first;
  const std::string input = picture("input");
  CHECK(count_of(input, "--cycle") >= triangles);
  CHECK(count_of(picture("front"), "--cycle") < triangles);
  CHECK(picture("final") != input);
}

TEST_CASE("pictures: surfaces in space from any viewpoint, and flat ones as before") {
  const TemporaryDirectory directory;
  make_msh(directory / "box.msh", 4.1, false, [] {
    ::gmsh::model::occ::addBox(0, 0, 0, 1, 2, 3);
    ::gmsh::model::occ::synchronize();
    ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
    ::gmsh::model::mesh::generate(2);
  });
  make_msh(directory / "flat.msh", 4.1, false, build_two_squares);
  const auto picture = [&](const std::string& name, const std::vector<std::string>& words) {
    std::vector<std::string> all{directory / name, "-o", directory / "out.msh", "--svg", directory / "a.svg"};
    all.insert(all.end(), words.begin(), words.end());
    REQUIRE(run_qmorph(all).status == 0);
    return read_file(directory / "a.svg");
  };
  const auto shape = [](const std::string& svg) {  // width over height
    double width = 0, height = 0;
    REQUIRE(std::sscanf(svg.c_str() + svg.find("width=") + 7, "%lfpt\" height=\"%lf", &width, &height) == 2);
    return (width - 6) / (height - 6);
  };
  CHECK(shape(picture("box.msh", {"--from", "x"})) == doctest::Approx(2.0 / 3).epsilon(1e-3));
  CHECK(shape(picture("box.msh", {"--from", "-y"})) == doctest::Approx(1.0 / 3).epsilon(1e-3));
  CHECK(shape(picture("box.msh", {"--from", "-1,0,0"})) == doctest::Approx(2.0 / 3).epsilon(1e-3));
  const auto faces = [](const std::string& svg) { return count_of(svg, "z\"/>"); };
  const std::size_t from_x = faces(picture("box.msh", {"--from", "x"})), three = faces(picture("box.msh", {}));
  CHECK(from_x > 10);
  CHECK(three > from_x);
  CHECK(picture("flat.msh", {"--from", "x"}) != picture("flat.msh", {}));
}

TEST_CASE("pictures: unknown names, and options of pictures without a picture, are refused before anything is read") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  const std::string in = directory / "in.msh", out = directory / "out.msh", svg = directory / "a.svg";
  CHECK(run_qmorph({in, "-o", out, "--svg", svg, "--stage", "seam"}).err.find("no stage 'seam'") != std::string::npos);
  CHECK(run_qmorph({in, "-o", out, "--svg", svg, "--colour", "red"}).err.find("no colouring 'red'") !=
        std::string::npos);
  CHECK(run_qmorph({in, "-o", out, "--svg", svg, "--from", "1,2"}).err.find("'1,2' is no direction") !=
        std::string::npos);
  CHECK(run_qmorph({in, "-o", out, "--from", "x"}).status == 1);
  CHECK(run_qmorph({in, "-o", out, "--stage", "front"}).status == 1);
  CHECK(run_qmorph({in, "-o", out, "--svg", out}).status == 1);
  CHECK(directory.files() == std::vector<std::string>{"in.msh"});
}

TEST_CASE("views: Gmsh reads the figures of every element from the mesh, text or binary, old or new") {
  for (double version : {4.1, 2.2})
    for (bool binary : {false, true}) {
      CAPTURE(version);
      CAPTURE(binary);
      const TemporaryDirectory directory;
      make_msh(directory / "in.msh", version, binary, build_two_squares);
      const std::string out = directory / "out.msh";
      REQUIRE(run_qmorph({directory / "in.msh", "-o", out, "--views"}).status == 0);
      CHECK(directory.files() == std::vector<std::string>{"in.msh", "out.msh"});
      const Snapshot after = read_snapshot(out);
      std::size_t elements = 0;
      for (int surface : {1, 2})
        elements += element_counts(after, surface).first + element_counts(after, surface).second;
      const ReadViews views = read_views(out);
      REQUIRE(views.counts.size() >= 4);
      CHECK(views.counts[0] == std::pair<std::string, std::size_t>("scaled Jacobian", elements));
      CHECK(views.counts[3] == std::pair<std::string, std::size_t>("size", elements));
      CHECK(views.least > 0.3);
      CHECK(views.least <= 1);
    }
}

TEST_CASE("views: formats without a place for them get a file beside the mesh") {
  for (const std::string format : {"su2", "vtk", "msh1"}) {
    CAPTURE(format);
    const TemporaryDirectory directory;
    make_msh(directory / "in.msh", 4.1, false, build_two_squares);
    REQUIRE(run_qmorph({directory / "in.msh", "-o", directory / ("out." + format), "--views"}).status == 0);
    const std::string pos = read_file(directory / "out.pos");
    CHECK(count_of(pos, "View \"") == 4);
    CHECK(count_of(pos, "SQ(") > 20);
  }
}

TEST_CASE("view: where there is no display it says so, and the mesh is written all the same") {
  const char* display = std::getenv("DISPLAY");
  const char* wayland = std::getenv("WAYLAND_DISPLAY");
  if ((display && *display) || (wayland && *wayland)) return;
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--view"});
  CHECK(result.status == 0);
  CHECK(result.err.find("qmorph: --view: there is no display") != std::string::npos);
  CHECK(directory.files() == std::vector<std::string>{"in.msh", "out.msh"});
}
