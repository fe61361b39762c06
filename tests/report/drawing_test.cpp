// SPDX-License-Identifier: GPL-2.0-or-later
/// Drawings as files, and scenes as drawings.

#include "report/drawing.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "report/picture.hpp"

using namespace qmorph;
using namespace qmorph::report;

namespace {

/// A grey triangle and a red line on a page of 10 x 20 points.
Drawing small_drawing() {
  Drawing drawing;
  drawing.size = {10, 20};
  drawing.shapes.push_back({{{{{0, 0}, {10, 0}, {0, 5}}, true}}, Colour{128, 128, 128}, {}, 0});
  drawing.shapes.push_back({{{{{1, 1}, {2, 3}}, false}}, {}, Colour{255, 0, 0}, 0.5});
  return drawing;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A square of two by two quads; the one at the bottom left is turned over.
Scene four_quads() {
  Scene scene;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) scene.points.emplace_back(x, y, 0);
  scene.node_tags.assign(9, 0);
  scene.faces = {{0, 3, 4, 1}, {1, 2, 5, 4}, {3, 4, 7, 6}, {4, 5, 8, 7}};
  scene.face_tags.assign(4, 0);
  scene.surfaces = {{1, {}, 0, 4}};
  return scene;
}

std::size_t shapes_of(const Drawing& drawing, const Colour& fill) {
  return std::size_t(std::count_if(drawing.shapes.begin(), drawing.shapes.end(),
                                   [&](const Shape& shape) { return shape.fill == fill; }));
}

}  // namespace

TEST_CASE("drawing: SVG, with y upwards and relative steps") {
  const std::string svg = to_svg(small_drawing());
  CHECK(has(svg, "viewBox=\"0 0 10.00 20.00\""));
  CHECK(has(svg, "matrix(0.05 0 0 -0.05 0 20.00)"));
  CHECK(has(svg, "fill=\"#808080\" d=\"M0 0l200 0 -200 100z\""));
  CHECK(has(svg, "stroke=\"#ff0000\" stroke-width=\"10.0\" d=\"M20 20l20 40\""));
}

TEST_CASE("drawing: PDF, whose table says where its objects are") {
  const std::string pdf = to_pdf(small_drawing());
  CHECK(pdf.rfind("%PDF-1.4\n", 0) == 0);
  CHECK(has(pdf, "/MediaBox [0 0 10.00 20.00]"));
  CHECK(has(pdf, "0 0 m\n200 0 l\n0 100 l\nh\nf\n"));
  CHECK(has(pdf, "20 20 m\n40 60 l\nS\n"));
  const std::size_t table = pdf.find("xref\n");
  CHECK(has(pdf, "startxref\n" + std::to_string(table) + "\n%%EOF\n"));
  for (int object = 1; object <= 4; ++object) {
    const std::size_t at = std::stoul(pdf.substr(table + 9 + 20 * std::size_t(object), 10));
    CHECK(pdf.compare(at, 7, std::to_string(object) + " 0 obj") == 0);
  }
}

TEST_CASE("drawing: TikZ, each colour defined once") {
  const std::string tikz = to_tikz(small_drawing());
  CHECK(has(tikz, "\\definecolor{qmorph0}{RGB}{128,128,128}\n\\path[fill=qmorph0]\n(0,0)--(200,0)--(0,100)--cycle;"));
  CHECK(has(tikz, "\\path[draw=qmorph1,line width=0.50bp]\n(20,20)--(40,60);"));
  CHECK(has(tikz, "\\end{tikzpicture}"));
}

TEST_CASE("drawing: the scale gets lighter from end to end") {
  const auto lightness = [](const Colour& c) { return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue; };
  for (int i = 1; i <= 20; ++i) CHECK(lightness(on_scale(i / 20.0)) > lightness(on_scale((i - 1) / 20.0)));
  CHECK(on_scale(-1) == on_scale(0));
  CHECK(on_scale(2) == on_scale(1));
}

TEST_CASE("picture: squares are pale, what is turned over is magenta, sizes fill the scale") {
  // Nobody can say which is right where one of four is turned over, so it is given a surface with more.
  Scene scene = four_quads();
  for (int i = 0; i < 4000; ++i) scene.faces.push_back({4, 5, 8, 7});
  scene.surfaces[0].count = scene.faces.size();
  scene.face_tags.resize(scene.faces.size());
  const Drawing drawing = draw(scene, PictureColour::scaled_jacobian);
  CHECK(drawing.size.x() == doctest::Approx(drawing.size.y()));
  CHECK(drawing.size.x() > 400);
  CHECK(shapes_of(drawing, kInvertedColour) == 1);
  CHECK(shapes_of(drawing, on_scale(39.5 / 40)) == 1);
  CHECK(shapes_of(draw(four_quads(), PictureColour::none), Colour{255, 255, 255}) == 1);
  CHECK(draw(Scene{}, PictureColour::size).shapes.empty());
  CHECK(find_picture_colour("thesis") == PictureColour::thesis_metric);
  CHECK_FALSE(find_picture_colour("red"));
}

TEST_CASE("picture: in space what is behind is painted first") {
  Scene scene = four_quads();
  scene.points[8].z() = 1;
  const Drawing drawing = draw(scene, PictureColour::eta);
  // Each of the four faces on its own, with the boundary beside it.
  CHECK(drawing.shapes.size() == 8);
}
