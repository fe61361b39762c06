// SPDX-License-Identifier: GPL-2.0-or-later
/// What pages and pictures are made from.

#include "report/scene.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "report/blob.hpp"
#include "report/page.hpp"

using namespace qmorph;
using namespace qmorph::report;

namespace {

/// A triangle 0 1 4 beside a quad 1 2 3 4, turned about the x axis.
///
///   4---3
///  /|   |
/// 0-1---2
Scene triangle_and_quad(double turn) {
  Scene scene;
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {1.0, 0.0}, {3.0, 0.0}, {3.0, 1.0}, {1.0, 1.0}})
    scene.points.emplace_back(x, y * std::cos(turn), y * std::sin(turn));
  scene.node_tags = {1, 2, 3, 4, 5};
  scene.faces = {{0, 1, 4, kNone}, {1, 2, 3, 4}};
  scene.face_tags = {7, 8};
  scene.lines = {{0, 1}};
  scene.surfaces = {{1, {}, 0, 2}};
  return scene;
}

}  // namespace

TEST_CASE("scene: figures of each face, in whatever plane it lies") {
  for (double turn : {0.0, 0.3, 2.0, std::numbers::pi}) {
    CAPTURE(turn);
    const SceneFigures figures = measure(triangle_and_quad(turn));
    REQUIRE(figures.scaled_jacobian.size() == 2);
    CHECK(figures.scaled_jacobian[0] == doctest::Approx(std::sqrt(0.5)));
    CHECK(figures.scaled_jacobian[1] == doctest::Approx(1));
    CHECK(std::isnan(figures.eta[0]));
    CHECK(figures.eta[1] == doctest::Approx(1));
    CHECK(figures.size[1] == doctest::Approx(1.5));
    // Sides with one element and no line element: 1-2, 2-3, 3-4, 4-0.
    CHECK(figures.open_edges.size() == 4);
    CHECK(figures.irregular.empty());
  }
}

TEST_CASE("scene: a quad that is turned over among others is inverted") {
  Scene scene = triangle_and_quad(0);
  for (int i = 0; i < 3000; ++i) {  // one of many, else nobody can say which is right
    scene.faces.push_back({1, 2, 3, 4});
    scene.face_tags.push_back(0);
  }
  scene.faces[1] = {4, 3, 2, 1};
  scene.surfaces[0].count = scene.faces.size();
  const SceneFigures figures = measure(scene);
  CHECK(figures.scaled_jacobian[1] < 0);
  CHECK(figures.scaled_jacobian[2] == doctest::Approx(1));
}

TEST_CASE("scene: nodes inside with three and five edges are marked, those of the boundary are not") {
  // A hexagon of three quads around node 6.
  Scene scene;
  for (int i = 0; i < 6; ++i)
    scene.points.emplace_back(std::cos(i * std::numbers::pi / 3), std::sin(i * std::numbers::pi / 3), 0);
  scene.points.emplace_back(0, 0, 0);
  scene.node_tags.assign(7, 0);
  scene.faces = {{6, 0, 1, 2}, {6, 2, 3, 4}, {6, 4, 5, 0}};
  scene.face_tags = {1, 2, 3};
  scene.surfaces = {{1, {}, 0, 3}};
  const SceneFigures figures = measure(scene);
  REQUIRE(figures.irregular.size() == 1);
  CHECK(figures.irregular[0].node == 6);
  CHECK(figures.irregular[0].valence == 3);
}

TEST_CASE("scene: the frame is the model's x and y where possible, and every plane is flat in its own frame") {
  const Frame plain = find_frame(triangle_and_quad(0));
  CHECK(plain.flat);
  CHECK(plain.right == Eigen::Vector3d(1, 0, 0));
  CHECK(plain.up == Eigen::Vector3d(0, 1, 0));
  CHECK(plain.centre.isApprox(Eigen::Vector3d(1.5, 0.5, 0)));
  const Frame turned = find_frame(triangle_and_quad(1.0));
  CHECK(turned.flat);
  CHECK(std::abs(turned.to_frame({3, std::cos(1.0), std::sin(1.0)}).z()) < 1e-12);
  Scene folded = triangle_and_quad(0);
  folded.points[0].z() = 1;
  CHECK_FALSE(find_frame(folded).flat);
  CHECK(find_frame(Scene{}).flat);
}

TEST_CASE("blob: base64, and arrays where the table says") {
  Blob blob;
  const std::vector<std::uint8_t> bytes{77, 97, 110, 1};
  CHECK(blob.add(std::span<const std::uint8_t>(bytes)).dump() == R"({"type":"u8","at":0,"count":4})");
  CHECK(blob.text() == "TWFuAQ==");
  const std::vector<float> floats{1};
  CHECK(blob.add(std::span<const float>(floats)).dump() == R"({"type":"f32","at":8,"count":1})");
  CHECK(blob.size() == 12);
  CHECK(blob.add_tags(std::vector<std::size_t>{std::size_t(1) << 33})["type"] == "f64");
}

TEST_CASE("page: the words of a command are quoted for the shell") {
  CHECK(shell_word("plate.msh") == "plate.msh");
  CHECK(shell_word("my plate.msh") == "'my plate.msh'");
  CHECK(shell_word("it's") == "'it'\\''s'");
  CHECK(shell_word("") == "''");
}
