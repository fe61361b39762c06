// SPDX-License-Identifier: GPL-2.0-or-later
// The window: other models, what cannot be converted, drawings, the mouse.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <gmsh.h>

#include "gui/window.hpp"

using namespace qmorph;
using namespace qmorph::test;

TEST_CASE("window: a surface that cannot be converted is named, with the reason, and the others become quads") {
  const TemporaryDirectory directory;
  const std::string path = directory / "three.msh";
  const Grid good, bad{.x = 5, .first_node = 26};
  std::vector<std::string> elements;
  for (const auto& t : good.triangles()) elements.push_back(row("2 2 0 1", t));
  for (const auto& t : bad.triangles()) elements.push_back(row("2 2 0 7", t));
  elements.push_back(row("2 2 0 7", bad.triangles()[0]));  // the same triangle twice
  std::vector<std::array<double, 3>> nodes = good.nodes();
  for (const auto& node : bad.nodes()) nodes.push_back(node);
  write_file(path, msh22(nodes, elements));
  Window window({path});
  window.press(action::kConvert);
  CHECK(window.said("surface 7"));
  CHECK(figure("Left as they were") == "7");
  CHECK(counts().second > 0);
  std::vector<int> views;
  gmsh::view::getTags(views);
  bool highlighted = false;
  for (int view : views) {
    std::string name;
    gmsh::option::getString(fmt::format("View[{}].Name", gmsh::view::getIndex(view)), name);
    highlighted = highlighted || name.find("surface 7") != std::string::npos;
  }
  CHECK(highlighted);
}

TEST_CASE("window: where nothing could be converted, there are no figures and no colours of quads") {
  const TemporaryDirectory directory;
  const std::string path = directory / "bad.msh";
  const Grid bad;
  std::vector<std::string> elements;
  for (const auto& t : bad.triangles()) elements.push_back(row("2 2 0 7", t));
  elements.push_back(row("2 2 0 7", bad.triangles()[0]));  // the same triangle twice
  write_file(path, msh22(bad.nodes(), elements));
  Window window({path});
  window.press(action::kConvert);
  CHECK(figure("Quads") == "0");
  CHECK(figure("Least SJ") == "-");
  CHECK(figure("Left as they were") == "7");
  std::vector<int> views;
  gmsh::view::getTags(views);
  CHECK(views.size() == 1);  // the surface that is left
}

TEST_CASE("window: another file opened in Gmsh's menu is the model from then on, and the panel stays") {
  const Plate plate;
  const TemporaryDirectory directory;
  const std::string path = directory / "two.msh";
  make_msh(path, 2.2, false, build_two_squares);
  Window window({plate.path});
  window.press(action::kConvert);
  gmsh::open(path);
  window.gui().turn(0.01);
  CHECK(window.gui().document().converted() == nullptr);
  window.press(action::kBack);
  CHECK(window.said("nothing to go back to"));
  window.press(action::kConvert);
  CHECK(window.saved() == written(path));
  gmsh::onelab::clear();
  window.gui().turn(0.01);
  CHECK(panel_is_there());
}

TEST_CASE("window: a parameter of the script changes the geometry") {
  const TemporaryDirectory directory;
  const std::string path = directory / "plate.geo";
  write_file(path,
             "SetFactory(\"OpenCASCADE\");\nDefineConstant[ w = {1, Name \"Width\"} ];\n"
             "Rectangle(1) = {0, 0, 0, w, 1};\nMesh.MeshSizeMax = 0.1;\n");
  Window window({path});
  window.press(action::kConvert);
  const std::size_t quads = counts().second;
  adapter::set_parameter("Width", 3);
  window.press("check");
  CHECK(counts().second == 0);
  window.press(action::kConvert);
  CHECK(counts().second > 2 * quads);
  CHECK(window.saved() == written(path + " -setnumber w 3"));
}

TEST_CASE("window: what the user changes in a mesh is not undone") {
  const Plate plate;
  Window window({plate.path});
  window.press(action::kConvert);
  gmsh::model::mesh::refine();
  const auto refined = counts();
  window.press(action::kBack);
  CHECK(window.said("nothing to go back to"));
  CHECK(counts() == refined);
}

TEST_CASE("window: begun with nothing, a drawing becomes quads") {
  Window window({});
  std::string script;
  gmsh::model::getFileName(script);  // Gmsh's menus append to it
  CHECK(std::filesystem::path(script).filename() == "untitled.geo");
  CHECK(!std::filesystem::exists(script));
  for (const auto& [x, y] : {std::pair(0., 0.), {1., 0.}, {1., 1.}, {0., 1.}}) gmsh::model::geo::addPoint(x, y, 0, 0.1);
  for (int i : {1, 2, 3, 4}) gmsh::model::geo::addLine(i, i % 4 + 1, i);
  gmsh::model::geo::addCurveLoop({1, 2, 3, 4}, 1);
  window.press(action::kConvert);
  CHECK(window.said("nothing to convert"));
  gmsh::model::geo::addPlaneSurface({1}, 1);
  gmsh::model::geo::synchronize();
  window.press(action::kConvert);
  CHECK(counts().first == 0);
  CHECK(counts().second > 50);
  CHECK(!window.saved().empty());
}

namespace {

bool has_xdotool() {
  if (std::system("command -v xdotool >/dev/null") == 0) return true;
  MESSAGE("skipped: there is no xdotool here");
  return false;
}

/// Words for a shell that clicks there, in pixels from the right and the lower end of the menu.
std::string click(int x, int y) {
  const int menu = static_cast<int>(adapter::get_option("General.MenuWidth"));
  return fmt::format(
      "eval $(xdotool search --onlyvisible --name '^Gmsh - ' getwindowgeometry --shell) && "
      "xdotool mousemove $((X + {})) $((Y + HEIGHT - {})) && sleep 0.3 && xdotool click 1 && sleep 0.3",
      menu + x, y);
}

}  // namespace

TEST_CASE("window: surfaces are picked with the mouse while quads and marks are shown") {
  if (!has_xdotool()) return;
  const Plate plate(kEllipse);
  Window window({plate.path});
  window.press(action::kConvert);
  for (int i = 0; i < 20; ++i) window.gui().turn(0.05);
  const auto visible = [] {
    std::vector<int> views;
    gmsh::view::getTags(views);
    return std::count_if(views.begin(), views.end(), [](int view) {
      return adapter::get_option(fmt::format("View[{}].Visible", gmsh::view::getIndex(view))) != 0;
    });
  };
  const auto before = visible();
  CHECK(before >= 2);
  // Beside the surface's cross, which goes through its middle, and on it.
  const std::string words = "(sleep 0.5; " + click(200, 315) + "; " + click(200, 381) + "; xdotool key e) >/dev/null &";
  REQUIRE(std::system(words.c_str()) == 0);
  window.press(action::kPick);
  CHECK(adapter::text_parameter(parameter::kSurfaces) == "3");
  CHECK(visible() == before);
}

TEST_CASE("window: a click of the mouse on the button is a press") {
  if (!has_xdotool()) return;
  const Plate plate;
  Window window({plate.path});
  for (int i = 0; i < 20; ++i) window.gui().turn(0.05);
  // The button is to the left of the gear, at the lower end of the tree.
  REQUIRE(std::system(click(-85, 38).c_str()) == 0);
  for (int i = 0; i < 100 && counts().second == 0; ++i) window.gui().turn(0.05);
  CHECK(counts().first == 0);
  CHECK(counts().second > 100);
}
