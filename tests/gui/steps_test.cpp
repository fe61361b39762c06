// SPDX-License-Identifier: GPL-2.0-or-later
// The window: the front step by step, views, and long work.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <gmsh.h>

#include "gui/window.hpp"

using namespace qmorph;
using namespace qmorph::test;

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
  CHECK(figure("Quads").empty());

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
  CHECK(figure("Quads") == std::to_string(counts().second));
  CHECK(window.saved() == expected);
  window.press(action::kBackward);
  CHECK(figure("Quads").empty());
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

TEST_CASE("window: views show the colouring that is chosen, and vanish with the quads") {
  const Plate plate(kEllipse);
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
