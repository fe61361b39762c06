// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/gui/result_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "report/drawing.hpp"

namespace qmorph::cli {
namespace {

using report::PictureColour;
using report::Scene;
using report::SceneFigures;

/// As many as a scale has steps that an eye can tell.
constexpr int kScaleColours = 64;
constexpr double kMarkSize = 5;

constexpr adapter::Rgb kThree{230, 97, 1}, kFive{31, 90, 200}, kOther{0, 0, 0}, kLeft{214, 39, 40};

struct Column {
  const char* name;
  const std::vector<float>* values;
};

Column column_of(PictureColour colour, const SceneFigures& figures) {
  switch (colour) {
    case PictureColour::scaled_jacobian:
      return {"scaled Jacobian", &figures.scaled_jacobian};
    case PictureColour::eta:
      return {"eta", &figures.eta};
    case PictureColour::thesis_metric:
      return {"thesis metric", &figures.thesis_metric};
    case PictureColour::size:
      return {"size", &figures.size};
    case PictureColour::none:
      break;
  }
  return {"", nullptr};
}

void show_colours(const Scene& scene, const SceneFigures& figures, PictureColour colour, adapter::ViewStyle style,
                  adapter::ShownViews& views) {
  const Column column = column_of(colour, figures);
  std::vector<std::size_t> tags;
  std::vector<double> values;
  for (std::size_t f = 0; f < scene.faces.size(); ++f) {
    const double value = (*column.values)[f];
    if (std::isnan(value)) continue;
    tags.push_back(scene.face_tags[f]);
    values.push_back(value);
  }
  if (values.empty()) return;
  style.name = column.name;
  style.colours = colours_on_scale(kScaleColours);
  if (colour == PictureColour::size) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    style.least = *least, style.most = *most;
  }
  views.add_on_elements(style, tags, values);
}

void show_marks(const Scene& scene, const SceneFigures& figures, adapter::ShownViews& views) {
  adapter::ViewData three, five, other;
  for (const auto& [node, valence] : figures.irregular)
    (valence == 3 ? three : valence == 5 ? five : other).point(scene.points[node], valence);
  const auto add = [&](const char* name, adapter::Rgb colour, const adapter::ViewData& data) {
    views.add({.name = name, .colours = {colour}, .least = 0, .most = 10, .points = kMarkSize}, data);
  };
  add("three edges", kThree, three);
  add("five edges", kFive, five);
  add("two edges, six or more", kOther, other);
}

void show_left(const Scene& scene, const std::vector<int>& left, adapter::ShownViews& views) {
  for (const report::SceneEntity& surface : scene.surfaces) {
    if (!std::count(left.begin(), left.end(), surface.tag)) continue;
    adapter::ViewData data;
    for (std::size_t f = surface.first; f < surface.first + surface.count; ++f) {
      const auto& n = scene.faces[f];
      const auto p = [&](int i) -> const Eigen::Vector3d& { return scene.points[n[static_cast<std::size_t>(i)]]; };
      if (report::corners_of(n) == 3)
        data.triangle(p(0), p(1), p(2), 0);
      else
        data.quad(p(0), p(1), p(2), p(3), 0);
    }
    views.add({.name = "surface " + std::to_string(surface.tag) + " is left as it was", .colours = {kLeft}}, data);
  }
}

}  // namespace

std::vector<adapter::Rgb> colours_on_scale(int count) {
  std::vector<adapter::Rgb> colours;
  for (int i = 0; i < count; ++i) {
    const report::Colour colour = report::on_scale(count > 1 ? double(i) / (count - 1) : 0.5);
    colours.push_back({colour.red, colour.green, colour.blue});
  }
  return colours;
}

void show_result(const Scene& scene, PictureColour colour, bool irregular, const std::vector<int>& left,
                 adapter::ShownViews& views) {
  views.clear();
  const SceneFigures figures = measure(scene);
  if (colour != PictureColour::none) show_colours(scene, figures, colour, {.scale = true}, views);
  if (irregular) show_marks(scene, figures, views);
  show_left(scene, left, views);
  views.style();
}

void show_second(const Scene& scene, PictureColour colour, bool irregular, adapter::ShownViews& views) {
  const SceneFigures figures = measure(scene);
  const bool any = colour != PictureColour::none;
  show_colours(scene, figures, any ? colour : PictureColour::scaled_jacobian, {.outlines = true}, views);
  if (irregular) show_marks(scene, figures, views);
  views.style();
}

}  // namespace qmorph::cli
