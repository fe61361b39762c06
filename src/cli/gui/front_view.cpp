// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/gui/front_view.hpp"

#include "report/drawing.hpp"

namespace qmorph::cli {
namespace {

constexpr adapter::Rgb kAhead{235, 238, 242}, kBehind{158, 202, 225}, kMade{253, 174, 97}, kBase{215, 25, 28};
/// Rows of quads come in these, over and over; states of an edge have the first three.
const std::vector<adapter::Rgb> kFront = {{27, 120, 55}, {118, 42, 131}, {8, 64, 129}, {166, 86, 40}, {60, 60, 60}};
constexpr double kFrontWidth = 3, kBaseWidth = 4;

double value_of(const FrontEdge& edge, FrontColour colour) {
  if (colour == FrontColour::state) return double(edge.origin_corner) + double(edge.target_corner);
  return double(edge.level % kFront.size());
}

/// Where the base edge of the last step was, if its nodes are still there.
void add_base(const FrontState& front, adapter::ViewData& data) {
  const FrontLog::Step& step = front.log().steps[front.position() - 1];
  if (step.base_origin == kNone || step.base_target == kNone) return;
  const Eigen::Vector3d a = front.point(step.base_origin), b = front.point(step.base_target);
  if (a.allFinite() && b.allFinite()) data.line(a, b, 0);
}

}  // namespace

void show_front(const FrontPlayer& player, FrontColour colour, adapter::ShownViews& views) {
  views.clear();
  adapter::ViewData ahead, behind, made, edges, base;
  for (const FrontState& front : player.fronts()) {
    const bool is_last = &front == player.last();
    for (Index f = 0; f < front.faces().size(); ++f) {
      const auto& n = front.faces()[f];
      if (n[0] == kNone) continue;
      const auto p = [&](std::size_t i) { return front.point(n[i]); };
      if (n[3] == kNone)
        ahead.triangle(p(0), p(1), p(2), 0);
      else
        (is_last && front.is_new(f) ? made : behind).quad(p(0), p(1), p(2), p(3), 0);
    }
    for (const auto& [number, edge] : front.edges())
      edges.line(front.point(edge.origin), front.point(edge.target), value_of(edge, colour));
    if (is_last) add_base(front, base);
  }
  const auto area = [&](const char* name, adapter::Rgb fill, const adapter::ViewData& data) {
    views.add({.name = name, .colours = {fill}, .outlines = true}, data);
  };
  area("triangles ahead", kAhead, ahead);
  area("quads", kBehind, behind);
  area("quads of the last step", kMade, made);
  views.add({.name = colour == FrontColour::level ? "front by level" : "front by state",
             .colours = kFront,
             .least = 0,
             .most = double(kFront.size() - 1),
             .width = kFrontWidth},
            edges);
  views.add({.name = "base edge", .colours = {kBase}, .width = kBaseWidth}, base);
  views.style();
}

}  // namespace qmorph::cli
