// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/window/shown_views.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/scratch_file.hpp"
#include "gmsh/session/session.hpp"

namespace qmorph::adapter {

void ViewData::add(std::vector<double>& list, std::initializer_list<const Eigen::Vector3d*> corners, double value) {
  for (int axis : {0, 1, 2})
    for (const Eigen::Vector3d* p : corners) list.push_back((*p)[axis]);
  list.insert(list.end(), corners.size(), value);
}

void ShownViews::add(const ViewStyle& style, const ViewData& data) {
  if (data.is_empty()) return;
  const int view = ::gmsh::view::add(style.name);
  const auto add_list = [&](const char* type, const std::vector<double>& list, std::size_t numbers) {
    if (!list.empty()) ::gmsh::view::addListData(view, type, static_cast<int>(list.size() / numbers), list);
  };
  add_list("SP", data.points, 4);
  add_list("SL", data.lines, 8);
  add_list("ST", data.triangles, 12);
  add_list("SQ", data.quads, 16);
  begin(style, view);
}

void ShownViews::add_on_elements(const ViewStyle& style, const std::vector<std::size_t>& tags,
                                 const std::vector<double>& values) {
  if (tags.empty()) return;
  std::string model;
  ::gmsh::model::getCurrent(model);
  const int view = ::gmsh::view::add(style.name);
  ::gmsh::view::addHomogeneousModelData(view, 0, model, "ElementData", tags, values, 0, 1);
  begin(style, view);
}

void ShownViews::begin(const ViewStyle& style, int view) {
  tags_.push_back(view);
  const std::string prefix = fmt::format("View[{}].", ::gmsh::view::getIndex(view));
  const auto set = [&](const char* option, double value) { set_option(prefix + option, value); };
  set("RangeType", 2);
  set("CustomMin", style.least);
  set("CustomMax", style.most);
  set("SaturateValues", 1);
  set("IntervalsType", 2);
  set("ShowScale", style.scale);
  set("ShowElement", style.outlines);
  set("LineWidth", style.width);
  set("LineType", style.outlines ? 0 : 1);  // and so do cylinders
  set("PointSize", style.points);
  set("PointType", 1);
  set("Light", 0);
  const auto out = std::back_inserter(script_);
  fmt::format_to(out, "{}ColorTable = {{", prefix);
  for (std::size_t i = 0; i < style.colours.size(); ++i)
    fmt::format_to(out, "{}{{{}, {}, {}}}", i ? ", " : "", style.colours[i][0], style.colours[i][1],
                   style.colours[i][2]);
  script_ += "};\n";
}

void ShownViews::style() {
  if (script_.empty()) return;
  const ScratchFile file(".geo");
  std::ofstream(file.path()) << script_;
  script_.clear();
  const ScopedOption quiet("General.Verbosity", 1);
  ::gmsh::merge(file.path());
}

void ShownViews::clear() {
  std::vector<int> there;
  ::gmsh::view::getTags(there);
  for (int view : tags_)
    if (std::count(there.begin(), there.end(), view)) ::gmsh::view::remove(view);
  tags_.clear();
  script_.clear();
}

}  // namespace qmorph::adapter
