// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Our results as views in Gmsh's window.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace qmorph::adapter {

using Rgb = std::array<int, 3>;

/// How a view looks.
struct ViewStyle {
  std::string name{};
  std::vector<Rgb> colours{};    ///< from `least` to `most`
  double least = 0, most = 1;    ///< values outside get the colours at the ends
  bool scale = false;            ///< a legend of the colours is shown
  bool outlines = false;         ///< the sides of elements are drawn
  double width = 1, points = 4;  ///< of lines and points, in pixels
};

/// Points, lines, triangles and quads, each with one value.
class ViewData {
 public:
  void point(const Eigen::Vector3d& p, double value) { add(points, {&p}, value); }
  void line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double value) { add(lines, {&a, &b}, value); }
  void triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, double value) {
    add(triangles, {&a, &b, &c}, value);
  }
  void quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d,
            double value) {
    add(quads, {&a, &b, &c, &d}, value);
  }
  bool is_empty() const { return points.empty() && lines.empty() && triangles.empty() && quads.empty(); }

  std::vector<double> points, lines, triangles, quads;  ///< as Gmsh's lists have them

 private:
  static void add(std::vector<double>& list, std::initializer_list<const Eigen::Vector3d*> corners, double value);
};

/// Our views. Those of the user are not touched.
class ShownViews {
 public:
  /// Call style() afterwards: only then does the style take effect.
  void add(const ViewStyle& style, const ViewData& data);
  /// One value for each of these elements of the current model.
  void add_on_elements(const ViewStyle& style, const std::vector<std::size_t>& tags, const std::vector<double>& values);
  /// Applies the styles of the views added since the last call.
  void style();
  void clear();
  /// To be called when they have gone with their model.
  void forget() { tags_.clear(), script_.clear(); }
  std::size_t count() const { return tags_.size(); }

 private:
  void begin(const ViewStyle& style, int view);

  std::vector<int> tags_;
  std::string script_;  ///< sets the colours, which only a script can
};

}  // namespace qmorph::adapter
