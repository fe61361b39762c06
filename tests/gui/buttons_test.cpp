// SPDX-License-Identifier: GPL-2.0-or-later
// The window: convert, back to triangles, save, and what the panel asks for.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <gmsh.h>

#include "gui/window.hpp"

using namespace qmorph;
using namespace qmorph::test;

TEST_CASE("window: the button meshes a geometry and makes quads of it, and what it saves has the command's bytes") {
  const Plate plate;
  const std::string expected = written(plate.path);
  Window window({plate.path});
  CHECK(counts() == std::pair<std::size_t, std::size_t>(0, 0));
  window.press(action::kConvert);
  const auto [triangles, quads] = counts();
  CHECK(triangles == 0);
  CHECK(quads > 100);
  CHECK(figure("Quads") == std::to_string(quads));
  CHECK(figure("Triangles") == "0");
  CHECK(window.said("scaled Jacobian min"));
  CHECK(window.saved() == expected);
  CHECK(counts().second == quads);
}

TEST_CASE("window: \"back to triangles\" restores the very same mesh, and converting again gives the same quads") {
  const TemporaryDirectory directory;
  const std::string path = directory / "two.msh";
  make_msh(path, 4.1, true, build_two_squares);
  Window window({path});
  const adapter::ModelMesh before = adapter::read_model_mesh();
  window.press(action::kBack);
  CHECK(window.said("nothing to go back to"));
  const std::string triangles = window.saved();
  window.press(action::kConvert);
  const adapter::ModelMesh quads = adapter::read_model_mesh();
  CHECK(counts().second > 0);
  window.press(action::kBack);
  CHECK(same_mesh(before, adapter::read_model_mesh()));
  CHECK(figure("Quads").empty());
  CHECK(window.saved() == triangles);
  window.press(action::kConvert);
  CHECK(same_mesh(quads, adapter::read_model_mesh()));
  window.press(action::kConvert);
  CHECK(same_mesh(quads, adapter::read_model_mesh()));
  CHECK(window.saved() == written(path));
}

TEST_CASE("window: \"back to triangles\" shows them as they were shown before") {
  const TemporaryDirectory directory;
  const std::string path = directory / "two.msh";
  make_msh(path, 4.1, true, build_two_squares);
  Window window({path});
  const auto picture = [&] {
    for (int i = 0; i < 20; ++i) window.gui().turn(0.05);  // until the window has got its size
    gmsh::graphics::draw();
    const std::string file = directory / "window.ppm";
    gmsh::write(file);
    const std::string bytes = read_file(file);
    const std::size_t header = bytes.find("\n255\n");  // has the time
    REQUIRE(header < bytes.size());
    return bytes.substr(header);
  };
  const std::string triangles = picture();
  window.press(action::kConvert);
  CHECK((picture() != triangles));
  window.press(action::kBack);
  CHECK((picture() == triangles));
  gmsh::option::setNumber("Mesh.SurfaceEdges", 0);
  CHECK((picture() != triangles));
  window.press(action::kConvert);
  window.press(action::kBack);
  CHECK(adapter::get_option("Mesh.SurfaceEdges") == 0);  // as the user has it
}

TEST_CASE("window: an existing file is overwritten only by a second press, and so are quads by triangles") {
  const Plate plate;
  const std::string path = plate.directory / "out.msh";
  write_file(path, "somebody's");
  Window window({plate.path});
  window.press(action::kConvert);
  adapter::set_parameter(parameter::kMeshFile, path);
  window.press(action::kSave);
  CHECK(read_file(path) == "somebody's");
  CHECK(window.said("is there already: press Save once more"));
  adapter::set_parameter(parameter::kMeshFile, plate.directory / "other.msh");
  window.press(action::kSave);
  CHECK(window.said("other.msh is written"));
  adapter::set_parameter(parameter::kMeshFile, path);
  window.press(action::kSave);  // it was another that the press was for
  CHECK(read_file(path) == "somebody's");
  window.press(action::kSave);
  const std::string quads = read_file(path);
  CHECK(quads.size() > 1000);
  std::filesystem::remove(path);
  write_file(path, "ours, since");
  window.press(action::kSave);  // no question about what the window has written
  CHECK(read_file(path) == quads);
  window.press(action::kBack);
  window.press(action::kSave);
  CHECK(read_file(path) == quads);
  CHECK(!window.said("has the triangles"));
  window.press(action::kSave);
  CHECK(read_file(path) != quads);
  CHECK(window.said("has the triangles"));
}

TEST_CASE("window: choices in the panel are those of the command's options") {
  const TemporaryDirectory directory;
  const std::string path = directory / "two.msh";
  make_msh(path, 4.1, false, build_two_squares);
  Window window({path});
  const auto expect = [&](const std::string& options) {
    window.press(action::kConvert);
    CHECK_MESSAGE(window.saved() == written('"' + path + "\" " + options), options);
  };
  adapter::set_parameter(parameter::kSurfaces, "2");
  expect("--surfaces 2");
  CHECK(counts().first > 0);
  adapter::set_parameter(parameter::kSurfaces, "all");

  const std::string pattern_rounds = "00qmorph/30Constants/cleanup.pattern_rounds";
  const double rounds = adapter::number_parameter(pattern_rounds, -1);
  CHECK(rounds == 3);
  const std::array switches = {std::tuple(std::string(parameter::kAllQuad), 0., 1., "--all-quad"),
                               std::tuple(std::string(parameter::kSmoothing), 0., 1., "--smoothing thesis"),
                               std::tuple(std::string(parameter::kCrease), 40., 180., "--crease 180"),
                               std::tuple(pattern_rounds, rounds, 0., "--set cleanup.pattern_rounds=0")};
  for (const auto& [name, usual, other, option] : switches) {
    adapter::set_parameter(name, other);
    expect(option);
    adapter::set_parameter(name, usual);
    expect("");
  }
}

TEST_CASE("window: settings that make no sense are refused with a message, and nothing is done") {
  const TemporaryDirectory directory;
  const std::string path = directory / "two.msh";
  make_msh(path, 4.1, false, build_two_squares);
  Window window({path});
  adapter::set_parameter(parameter::kSurfaces, "2, x");
  window.press(action::kConvert);
  CHECK(window.said("'x' is not a tag"));
  adapter::set_parameter(parameter::kSurfaces, "77");
  window.press(action::kConvert);
  CHECK(window.said("no surface 77"));
  adapter::set_parameter(parameter::kSurfaces, "all");
  adapter::set_parameter(parameter::kStepSurface, 77);
  window.press(action::kForward);
  CHECK(window.said("surface 77 has no front"));
  adapter::set_parameter(parameter::kCleanupOnly, 1);
  window.press(action::kForward);
  CHECK(window.said("no front then"));
  window.press(action::kBack);
  CHECK(counts().second == 0);
  adapter::set_parameter(parameter::kMeshFile, directory / "nowhere/out.msh");
  window.press(action::kSave);
  CHECK(window.said("nowhere"));
}

TEST_CASE("window: a new size factor meshes again what the window has meshed") {
  const Plate plate;
  Window window({plate.path});
  window.press(action::kConvert);
  const std::size_t quads = counts().second;
  adapter::set_parameter(parameter::kSizeFactor, 0.5);
  window.press(action::kConvert);
  CHECK(counts().second > 3 * quads);
  CHECK(window.saved() == written(plate.path + " -clscale 0.5"));
  adapter::set_parameter(parameter::kSizeFactor, 1);
  window.press(action::kConvert);
  CHECK(counts().second == quads);
}
