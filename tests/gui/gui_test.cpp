// SPDX-License-Identifier: GPL-2.0-or-later
/// Gmsh's window with our panel, on a display that nobody sees: buttons are pressed, and the model is looked at.

#include "cli/gui/gui.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <gmsh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "cli/gui/progress.hpp"
#include "gmsh/support.hpp"
#include "gmsh/window/snapshot.hpp"

using namespace qmorph;
using namespace qmorph::cli;
using namespace qmorph::test;
namespace parameter = qmorph::cli::parameter;

namespace {

constexpr const char* kPlate =
    "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 2, 1};\nDisk(2) = {1, 0.5, 0, 0.2};\n"
    "BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };\n"
    "Physical Surface(\"plate\", 1) = {3};\nMesh.MeshSizeMax = 0.1;\n";

/// Gmsh's session with our window in it.
class Window {
 public:
  explicit Window(std::vector<std::string> words)
      : words_(std::move(words)),
        request_(parse([&] {
          std::vector<std::string> all = words_;
          all.push_back("--gui");
          return all;
        }())),
        err_(stream_),
        call_{request_, words_, stream_, err_, process_},
        gui_(call_, session_) {}

  Gui& gui() { return gui_; }
  void press(const std::string& action) {
    adapter::ask_for(action);
    gui_.turn(0.01);
  }
  bool said(const std::string& part) const {
    return std::any_of(gui_.said().begin(), gui_.said().end(),
                       [&](const std::string& line) { return line.find(part) != std::string::npos; });
  }
  /// What the button saves, byte by byte.
  std::string saved() {
    adapter::set_parameter(parameter::kMeshFile, directory_ / "saved.msh");
    press(action::kSave);
    return read_file(directory_ / "saved.msh");
  }

 private:
  TemporaryDirectory directory_;
  std::ostringstream stream_;
  const std::vector<std::string> words_;
  const Request request_;
  const Process process_{};
  ErrorStream err_;
  const Call call_;
  adapter::Session session_{request_.gmsh_arguments};
  Gui gui_;
};

/// Triangles and quads of the current model.
std::pair<std::size_t, std::size_t> counts() {
  std::pair<std::size_t, std::size_t> result{0, 0};
  const adapter::ModelMesh mesh = adapter::read_model_mesh();
  for (const adapter::EntityMesh& entity : mesh.entities) {
    if (entity.dim != 2) continue;
    if (const auto* block = entity.polygons(3)) result.first += block->tags.size();
    if (const auto* block = entity.polygons(4)) result.second += block->tags.size();
  }
  return result;
}

/// What the command writes for these words.
std::string written(const std::string& words) {
  const TemporaryDirectory directory;
  const std::string out = directory / "command.msh";
  REQUIRE(std::system(fmt::format("\"{}\" {} -v 0 -o \"{}\"", QMORPH_COMMAND, words, out).c_str()) == 0);
  return read_file(out);
}

bool same_mesh(const adapter::ModelMesh& a, const adapter::ModelMesh& b) {
  if (a.tags != b.tags || a.points != b.points || a.owner != b.owner || a.entities.size() != b.entities.size())
    return false;
  for (std::size_t e = 0; e < a.entities.size(); ++e) {
    const auto &x = a.entities[e].blocks, &y = b.entities[e].blocks;
    if (x.size() != y.size() || a.entities[e].uv != b.entities[e].uv) return false;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (x[i].type != y[i].type || x[i].tags != y[i].tags || x[i].nodes != y[i].nodes) return false;
  }
  return true;
}

std::string figure(const std::string& name) {
  std::vector<std::string> names;
  gmsh::onelab::getNames(names, ".*/50Result/." + name);
  return names.empty() ? "" : adapter::text_parameter(names.front());
}

struct Plate {
  TemporaryDirectory directory;
  std::string path = directory / "plate.geo";
  Plate() { write_file(path, kPlate); }
};

}  // namespace

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

TEST_CASE("window: back to triangles brings back the very mesh, and quads again are the same quads") {
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

TEST_CASE("window: back to triangles shows them as they were shown before") {
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

TEST_CASE("window: what is chosen in the panel is what the command's options are") {
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

TEST_CASE("window: what makes no sense is refused in words, and nothing is done") {
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

TEST_CASE("window: a size factor meshes anew what the window has meshed") {
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

TEST_CASE("window: step by step, forward, back and to the end, which is what the command makes") {
  const Plate plate;
  const std::string expected = written(plate.path);
  Window window({plate.path});
  window.press(action::kForward);
  const FrontPlayer* player = window.gui().player();
  REQUIRE(player != nullptr);
  CHECK(player->position() == 1);
  CHECK(adapter::text_parameter(parameter::kStepDone) == fmt::format("1 of {}", player->count()));
  CHECK(adapter::text_parameter(parameter::kStepWords).rfind("quad of row 1", 0) == 0);
  CHECK(counts().second == 0);  // the model has its triangles until the end

  adapter::set_parameter(parameter::kSteps, 10);
  window.press(action::kForward);
  CHECK(player->position() == 11);
  const auto front_of = [&] {
    std::vector<std::array<Index, 3>> edges;
    for (const auto& [number, edge] : player->fronts()[0].edges())
      edges.push_back({edge.origin, edge.target, edge.level});
    return edges;
  };
  const auto faces = player->fronts()[0].faces();
  const auto front = front_of();
  adapter::set_parameter(parameter::kSteps, 100);
  window.press(action::kForward);
  CHECK(player->position() == 111);
  CHECK(player->fronts()[0].faces() != faces);
  window.press(action::kBackward);
  CHECK(player->position() == 11);
  CHECK(player->fronts()[0].faces() == faces);
  CHECK(front_of() == front);

  adapter::set_parameter(parameter::kSteps, kWholeRow);
  window.press(action::kForward);
  const std::size_t row = player->position();
  CHECK(row > 11);
  CHECK(row < player->count());
  window.press(action::kForward);
  CHECK(player->position() > row);
  window.press(action::kBackward);
  CHECK(player->position() == row);
  window.press(action::kToBegin);
  CHECK(player->position() == 0);
  window.press(action::kToEnd);
  CHECK(player->position() == player->count());
  CHECK(counts().first == 0);
  CHECK(window.saved() == expected);
  window.press(action::kBackward);
  CHECK(player->position() < player->count());
  CHECK(counts().second == 0);
  window.press(action::kConvert);
  CHECK(window.gui().player() == nullptr);
  CHECK(window.saved() == expected);
}

TEST_CASE("window: at each step triangles and quads cover the surface, and the front consists of loops") {
  const Plate plate;
  Window window({plate.path});
  window.press(action::kForward);
  FrontPlayer* player = const_cast<FrontPlayer*>(window.gui().player());
  REQUIRE(player != nullptr);
  const auto area = [&] {
    double sum = 0;
    for (const FrontState& front : player->fronts())
      for (const auto& n : front.faces()) {
        if (n[0] == kNone) continue;
        const Eigen::Vector3d a = front.point(n[0]), b = front.point(n[1]), c = front.point(n[2]);
        const Eigen::Vector3d d = n[3] == kNone ? c : front.point(n[3]);
        sum += (c - a).cross(d - b).z() / 2;
      }
    return sum;
  };
  player->go_to(0);
  const double whole = area();
  for (std::size_t at = 0; at <= player->count(); at += 7) {
    player->go_to(at);
    CHECK(area() == doctest::Approx(whole));
    for (const FrontState& front : player->fronts()) {
      std::map<Index, int> balance;
      for (const auto& [number, edge] : front.edges()) ++balance[edge.origin], --balance[edge.target];
      CHECK(std::all_of(balance.begin(), balance.end(), [](const auto& node) { return node.second == 0; }));
    }
  }
}

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

TEST_CASE("window: views show the colouring that is chosen, and go with the quads") {
  const Plate plate;
  Window window({plate.path});
  const auto views = [] {
    std::vector<int> tags;
    gmsh::view::getTags(tags);
    return tags.size();
  };
  window.press(action::kConvert);
  const std::size_t all = views();
  CHECK(all >= 2);
  adapter::set_parameter(parameter::kIrregular, 0);
  window.press("check");
  CHECK(views() == 1);
  adapter::set_parameter(parameter::kColour, 4);
  window.press("check");
  CHECK(views() == 0);
  adapter::set_parameter(parameter::kIrregular, 1);
  adapter::set_parameter(parameter::kColour, 3);
  window.press("check");
  CHECK(views() == all);
  window.press(action::kBack);
  CHECK(views() == 0);
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

TEST_CASE("window: pages, and Gmsh's own quads beside ours") {
  const Plate plate;
  const std::string expected = written(plate.path);
  Window window({plate.path});
  adapter::set_parameter(parameter::kReportFile, plate.directory / "report.html");
  adapter::set_parameter(parameter::kFilmFile, plate.directory / "film.html");
  window.press(action::kReport);
  CHECK(read_file(plate.directory / "report.html").size() > 10'000);
  CHECK(window.saved() == expected);
  window.press(action::kFilm);
  CHECK(read_file(plate.directory / "film.html").size() > 10'000);
  const std::size_t quads = counts().second;
  window.press(action::kCompare);
  CHECK(window.said("Gmsh's recombine: "));
  std::vector<std::string> models;
  gmsh::model::list(models);
  CHECK(models.size() == 2);
  CHECK(counts().second == quads);
  CHECK(window.saved() == expected);
  window.press(action::kConvert);
  models.clear();
  gmsh::model::list(models);
  CHECK(models.size() == 1);
  adapter::set_parameter(parameter::kFilmFile, plate.directory / "nowhere/film.html");
  window.press(action::kFilm);
  CHECK(window.said("nowhere"));
}

TEST_CASE("window: a second press cancels, and so does another model") {
  const Plate plate;
  Window window({plate.path});
  gmsh::model::mesh::generate(2);
  const auto before = counts();
  adapter::LiveWindow live;
  {
    WindowProgress progress(live);
    CHECK(progress("front", 0.5) == Progress::go_on);
  }
  {
    WindowProgress progress(live);
    adapter::ask_for(action::kCancel);
    CHECK(progress("front", 0.5) == Progress::cancel);
    CHECK(!progress.model_changed());
    CHECK(progress("front", 0.6) == Progress::cancel);
  }
  {
    WindowProgress progress(live);
    gmsh::model::mesh::clear();
    CHECK(progress("front", 0.5) == Progress::cancel);
    CHECK(progress.model_changed());
  }
  CHECK(before.first > 0);
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
  const Plate plate;
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
