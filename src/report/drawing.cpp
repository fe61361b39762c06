// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>

namespace qmorph::report {
namespace {

constexpr int kGrid = 20;  // steps to a point

using Place = std::array<long, 2>;

/// Places of a path on the grid.
std::vector<Place> on_grid(const Path& path) {
  std::vector<Place> places;
  for (const auto& p : path.points) places.push_back({std::lround(kGrid * p.x()), std::lround(kGrid * p.y())});
  return places;
}

template <class... Values>
void append(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
}

/// From OKLCH (hue in degrees) to sRGB; B. Ottosson, "A perceptual color space for image processing", 2020.
Colour from_oklch(double lightness, double chroma, double hue) {
  const double a = chroma * std::cos(hue * std::numbers::pi / 180), b = chroma * std::sin(hue * std::numbers::pi / 180);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  const auto byte = [](double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    return std::uint8_t(std::lround(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055)));
  };
  return {byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          byte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

std::string hex(const Colour& c) { return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue); }

/// Relative steps: half the size of places.
std::string svg_path(const Shape& shape) {
  std::string data;
  for (const Path& path : shape.paths) {
    Place before{};
    bool first = true;
    for (const Place& p : on_grid(path)) {
      if (first)
        append(data, "M{} {}l", p[0], p[1]);
      else
        append(data, "{} {} ", p[0] - before[0], p[1] - before[1]);
      before = p, first = false;
    }
    if (!data.empty() && data.back() == ' ') data.pop_back();
    if (path.closed) data += 'z';
  }
  return data;
}

std::string pdf_colour(const Colour& c, const char* operation) {
  return fmt::format("{:.3f} {:.3f} {:.3f} {}\n", c.red / 255.0, c.green / 255.0, c.blue / 255.0, operation);
}

std::string pdf_content(const Drawing& drawing) {
  std::string content = fmt::format("{:g} 0 0 {:g} 0 0 cm 1 j 1 J\n", 1.0 / kGrid, 1.0 / kGrid);
  for (const Shape& shape : drawing.shapes) {
    if (shape.fill) content += pdf_colour(*shape.fill, "rg");
    if (shape.stroke) content += pdf_colour(*shape.stroke, "RG") + fmt::format("{:.1f} w\n", kGrid * shape.width);
    for (const Path& path : shape.paths) {
      char operation = 'm';
      for (const Place& p : on_grid(path)) append(content, "{} {} {}\n", p[0], p[1], std::exchange(operation, 'l'));
      if (path.closed) content += "h\n";
    }
    content += shape.fill && shape.stroke ? "B\n" : shape.fill ? "f\n" : "S\n";
  }
  return content;
}

}  // namespace

Colour on_scale(double t) {
  const double x = std::clamp(t, 0.0, 1.0);
  return from_oklch(0.27 + 0.69 * x, 0.055 + 0.32 * x * (1 - x), 275 - 175 * x);
}

std::string to_svg(const Drawing& drawing) {
  const double width = drawing.size.x(), height = drawing.size.y();
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.2f}pt\" height=\"{1:.2f}pt\" viewBox=\"0 0 {0:.2f} "
      "{1:.2f}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n<g transform=\"matrix({2:g} 0 0 -{2:g} 0 "
      "{1:.2f})\" fill=\"none\" stroke-linejoin=\"round\" "
      "stroke-linecap=\"round\">\n",
      width, height, 1.0 / kGrid);
  for (const Shape& shape : drawing.shapes) {
    text += "<path";
    if (shape.fill) append(text, " fill=\"{}\"", hex(*shape.fill));
    if (shape.stroke) append(text, " stroke=\"{}\" stroke-width=\"{:.1f}\"", hex(*shape.stroke), kGrid * shape.width);
    append(text, " d=\"{}\"/>\n", svg_path(shape));
  }
  return text + "</g>\n</svg>\n";
}

std::string to_pdf(const Drawing& drawing) {
  const std::string content = pdf_content(drawing);
  const std::array<std::string, 4> objects = {
      "<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
      fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:.2f} {:.2f}] /Resources << >> /Contents 4 0 R >>",
                  drawing.size.x(), drawing.size.y()),
      fmt::format("<< /Length {} >>\nstream\n{}endstream", content.size(), content)};
  std::string text = "%PDF-1.4\n";
  std::string table = fmt::format("xref\n0 {}\n0000000000 65535 f \n", objects.size() + 1);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    append(table, "{:010} 00000 n \n", text.size());
    append(text, "{} 0 obj\n{}\nendobj\n", i + 1, objects[i]);
  }
  const std::size_t table_at = text.size();
  return text + table +
         fmt::format("trailer\n<< /Size {} /Root 1 0 R >>\nstartxref\n{}\n%%EOF\n", objects.size() + 1, table_at);
}

std::string to_tikz(const Drawing& drawing) {
  std::string text =
      fmt::format("\\begin{{tikzpicture}}[x={0:g}bp,y={0:g}bp,line join=round,line cap=round]\n", 1.0 / kGrid);
  std::map<std::string, std::string> names;
  const auto name = [&](const Colour& c) {
    const auto [found, is_new] = names.emplace(hex(c), fmt::format("qmorph{}", names.size()));
    if (is_new)
      append(text, "\\definecolor{{{}}}{{RGB}}{{{},{},{}}}\n", found->second, int(c.red), int(c.green), int(c.blue));
    return found->second;
  };
  for (const Shape& shape : drawing.shapes) {
    std::string options;
    if (shape.fill) options += "fill=" + name(*shape.fill);
    if (shape.stroke)
      append(options, "{}draw={},line width={:.2f}bp", options.empty() ? "" : ",", name(*shape.stroke), shape.width);
    append(text, "\\path[{}]", options);
    for (const Path& path : shape.paths) {
      const char* join = "\n";
      for (const Place& p : on_grid(path)) append(text, "{}({},{})", std::exchange(join, "--"), p[0], p[1]);
      if (path.closed) text += "--cycle";
    }
    text += ";\n";
  }
  return text + "\\end{tikzpicture}\n";
}

}  // namespace qmorph::report
