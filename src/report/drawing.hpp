// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Polygons and lines on a page, and the formats that papers take them in.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace qmorph::report {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  bool operator==(const Colour&) const = default;
};

/// Dark blue by green to pale yellow, for t from 0 to 1; lightness grows evenly, so that it reads the same with any
/// colour vision and in grey.
Colour on_scale(double t);
inline constexpr Colour kInvertedColour{208, 28, 139};  ///< an element that is turned over
inline constexpr Colour kUndefinedColour{150, 150, 150};

/// Lengths are in points (1/72 inch), y grows upwards.
struct Path {
  std::vector<Eigen::Vector2d> points;
  bool closed = true;
};

/// Paths that are painted together.
struct Shape {
  std::vector<Path> paths;
  std::optional<Colour> fill, stroke;
  double width = 0;  ///< of the stroke
};

/// Shapes from back to front, between (0, 0) and `size`.
struct Drawing {
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
  std::vector<Shape> shapes;
};

/// Files, whole. Coordinates are rounded to 1/20 point.
std::string to_svg(const Drawing& drawing);
std::string to_pdf(const Drawing& drawing);   ///< one page, without text
std::string to_tikz(const Drawing& drawing);  ///< a tikzpicture, for \input

}  // namespace qmorph::report
