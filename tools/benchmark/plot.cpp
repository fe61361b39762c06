// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "beside_gmsh.hpp"

namespace benchmark {
namespace {

constexpr double kPanelWidth = 300, kPanelHeight = 320, kGap = 36;  // pixels
constexpr double kLeft = 64, kTop = 66, kBottom = 52, kRight = 20;

struct Line {
  const char* label;
  const char* colour;
  const char* dashes;  // of the stroke, empty for none
  Ran Comparison::*ran;
};
constexpr Line kLines[] = {
    {"Gmsh makes the triangles", "#8a8a8a", "2 4", &Comparison::meshing},
    {"Gmsh, simple", "#d98c1f", "", &Comparison::simple},
    {"Gmsh, Blossom", "#b5322e", "", &Comparison::blossom},
    {"qmorph, 1 thread", "#1e64b4", "", &Comparison::one_thread},
    {"qmorph, 2 threads", "#1e64b4", "6 4", &Comparison::two_threads},
};

constexpr double kHair = 1.1;  // a value this close to a power of ten needs no further tick

/// Powers of ten around all values.
struct Decades {
  int first = 1000, last = -1000;
  void include(double value) {
    if (value <= 0) return;
    first = std::min(first, int(std::floor(std::log10(value * kHair))));
    last = std::max(last, int(std::ceil(std::log10(value / kHair))));
  }
  double share(double value) const { return (std::log10(value) - first) / std::max(1, last - first); }
};

/// "0.01", "100"
std::string seconds_label(int power) {
  return power < 0 ? fmt::format("{:.{}f}", std::pow(10, power), -power) : fmt::format("{:.0f}", std::pow(10, power));
}

/// "10 k", "1 M"
std::string triangles_label(int power) {
  const int step = std::clamp(power / 3, 0, 2);
  const char* const units[] = {"", " k", " M"};
  return fmt::format("{:.0f}{}", std::pow(10, power - 3 * step), units[step]);
}

class Plot {
 public:
  explicit Plot(const std::vector<Comparison>& comparisons) : comparisons_(comparisons) {
    for (const Comparison& c : comparisons) {
      if (std::find(kinds_.begin(), kinds_.end(), c.kind) == kinds_.end()) kinds_.push_back(c.kind);
      triangles_.include(double(c.triangles));
      for (const Line& line : kLines)
        if (const Ran& ran = c.*line.ran; ran.end == End::finished) seconds_.include(seconds(c, line.ran));
    }
  }

  std::string draw() {
    const double width = kLeft + double(kinds_.size()) * (kPanelWidth + kGap) - kGap + kRight;
    const double height = kTop + kPanelHeight + kBottom;
    text_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
        "height=\"{1:.0f}\" "
        "font-family=\"sans-serif\" font-size=\"12\">\n<title>Seconds from triangles to quads</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
        width, height);
    legend();
    for (std::size_t k = 0; k < kinds_.size(); ++k) panel(kLeft + double(k) * (kPanelWidth + kGap), kinds_[k], k == 0);
    return text_ + "</svg>\n";
  }

 private:
  void write(double x, double y, const char* anchor, const std::string& words, const char* more = "") {
    text_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"#303030\"{}>{}</text>\n", x, y,
                         anchor, more, words);
  }
  void stroke(double x1, double y1, double x2, double y2, const char* colour, double thick, const char* dashes = "") {
    text_ += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"{}\" "
        "stroke-dasharray=\"{}\"/>\n",
        x1, y1, x2, y2, colour, thick, *dashes ? dashes : "none");
  }

  void legend() {
    double x = kLeft;
    for (const Line& line : kLines) {
      stroke(x, 18, x + 26, 18, line.colour, 2.5, line.dashes);
      write(x + 32, 22, "start", line.label);
      x += 62 + 6.6 * double(std::string(line.label).size());
    }
  }

  double y_of(double seconds) const { return kTop + kPanelHeight * (1 - seconds_.share(seconds)); }

  void panel(double left, Kind kind, bool labels) {
    const auto x_of = [&](double triangles) { return left + kPanelWidth * triangles_.share(triangles); };
    const double bottom = kTop + kPanelHeight;
    for (int p = seconds_.first; p <= seconds_.last; ++p) {
      const double y = y_of(std::pow(10, p));
      stroke(left, y, left + kPanelWidth, y, "#dcdcdc", 1);
      if (labels) write(left - 8, y + 4, "end", seconds_label(p) + " s");
    }
    for (int p = triangles_.first; p <= triangles_.last; ++p) {
      const double x = x_of(std::pow(10, p));
      stroke(x, kTop, x, bottom, "#dcdcdc", 1);
      write(x, bottom + 18, "middle", triangles_label(p));
    }
    write(left + kPanelWidth / 2, kTop - 12, "middle", name_of(kind), " font-weight=\"bold\"");
    write(left + kPanelWidth / 2, bottom + 38, "middle", "triangles");
    for (const Line& line : kLines) curve(kind, line, x_of);
  }

  template <class XOf>
  void curve(Kind kind, const Line& line, const XOf& x_of) {
    std::string points, dots;
    for (const Comparison& c : comparisons_) {
      const Ran& ran = c.*line.ran;
      if (c.kind != kind || ran.end != End::finished) continue;
      const double x = x_of(double(c.triangles)), y = y_of(seconds(c, line.ran));
      points += fmt::format("{:.1f},{:.1f} ", x, y);
      dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", x, y, line.colour);
    }
    text_ += fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-dasharray=\"{}\"/>\n{}", points,
        line.colour, *line.dashes ? line.dashes : "none", dots);
  }

  const std::vector<Comparison>& comparisons_;
  std::vector<Kind> kinds_;
  Decades triangles_, seconds_;
  std::string text_;
};

}  // namespace

void write_plot(const std::vector<Comparison>& comparisons, const std::string& path) {
  FILE* file = std::fopen(path.c_str(), "w");
  const std::string text = Plot(comparisons).draw();
  if (!file || std::fwrite(text.data(), 1, text.size(), file) != text.size() || std::fclose(file) != 0) {
    std::perror(path.c_str());
    std::exit(5);
  }
}

}  // namespace benchmark
