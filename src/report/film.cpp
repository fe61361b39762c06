// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/film.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernel/sort_unique.hpp"

namespace qmorph::report {
namespace {

/// Smaller movements are not recorded, relative to a short edge of the mesh: nobody sees them. And surfaces, each
/// rounded in axes of its own, still meet at their rims.
constexpr double kQuantum = 1.0 / 256;
/// The edge that counts as short: so many are shorter.
constexpr double kShortEdges = 0.02;
constexpr double kMostSteps = 1 << 30;  // from one side of the region to the other
constexpr std::array<Index, 4> kNoFace{kNone, kNone, kNone, kNone};

Index count_corners(const std::array<Index, 4>& corners) {
  return corners[0] == kNone ? 0 : corners[3] == kNone ? 3 : 4;
}

double short_edge(const FrontStart& start) {
  std::vector<std::pair<Index, Index>> edges;
  for (const auto& face : start.faces)
    for (Index i = 0, corners = count_corners(face); i < corners; ++i)
      edges.push_back(std::minmax(face[i], face[(i + 1) % corners]));
  sort_unique(edges);
  std::vector<double> lengths;
  for (const auto& [a, b] : edges) lengths.push_back((start.points[b] - start.points[a]).norm());
  if (lengths.empty()) return 1;
  const auto at = lengths.begin() + std::ptrdiff_t(kShortEdges * double(lengths.size()));
  std::nth_element(lengths.begin(), at, lengths.end());
  return *at;
}

bool is_there(const Eigen::Vector2d& point) { return !std::isnan(point.x()); }

}  // namespace

FilmRecorder::FilmRecorder(const FrontStart& start)
    : corner_(Eigen::Vector2d::Zero()),
      places_(start.points.size(), Place{}),
      seen_(start.points.size(), false),
      faces_(start.faces.begin(), start.faces.end()) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& p : start.points)
    if (is_there(p)) low = low.cwiseMin(p), high = high.cwiseMax(p);
  if (low.x() <= high.x()) corner_ = low;
  quantum_ = std::max(
      {kQuantum * short_edge(start), (high - low).maxCoeff() / kMostSteps, std::numeric_limits<double>::min()});
  for (Index v = 0; v < start.points.size(); ++v)
    if (is_there(start.points[v])) places_[v] = place(start.points[v]), seen_[v] = true;
  film_.corner_angle = start.corner_angle;
  film_.origin = start.frame.origin + corner_.x() * start.frame.axis_u + corner_.y() * start.frame.axis_v;
  film_.axis_u = quantum_ * start.frame.axis_u;
  film_.axis_v = quantum_ * start.frame.axis_v;
  film_.points = places_;
  film_.places.assign(start.places.begin(), start.places.end());
  film_.faces = faces_;
}

FilmRecorder::Place FilmRecorder::place(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d p = (point - corner_) / quantum_;
  const auto rounded = [](double x) {
    return std::int32_t(std::lround(std::clamp(x, -kMostSteps, 2 * kMostSteps - 1)));
  };
  return {rounded(p.x()), rounded(p.y())};
}

void FilmRecorder::put(std::uint64_t number) {
  for (; number >= 128; number >>= 7) film_.bytes.push_back(std::uint8_t(number | 128));
  film_.bytes.push_back(std::uint8_t(number));
}

void FilmRecorder::put_signed(std::int64_t number) {
  put(number >= 0 ? 2 * std::uint64_t(number) : 2 * std::uint64_t(-(number + 1)) + 1);
}

void FilmRecorder::step(const FrontStep& step) {
  ++film_.steps;
  near_ = step.base_origin;
  film_.bytes.push_back(std::uint8_t(step.kind));
  if (step.kind == StepKind::quad) {
    film_.bytes.push_back(std::uint8_t(unsigned(step.left) + 8 * unsigned(step.right) + 64 * unsigned(step.met_front)));
    put(step.swaps);
  }
  put(step.base_origin);
  put_near(step.base_target);
  put_nodes(step.nodes);
  put_faces(step.faces);
  put_levels(step.edges);
}

void FilmRecorder::put_nodes(std::span<const FrontStep::Node> nodes) {
  if (!nodes.empty() && nodes.back().node >= places_.size()) {
    places_.resize(nodes.back().node + 1, Place{});
    seen_.resize(places_.size(), false);
  }
  moved_.clear();
  for (const FrontStep::Node& n : nodes)
    if (!seen_[n.node] || place(n.place) != places_[n.node]) moved_.push_back(n);
  put(moved_.size());
  Index before = near_;
  for (const FrontStep::Node& n : moved_) {
    put_signed(std::int64_t(n.node) - std::int64_t(before));
    const Place from = seen_[n.node] ? places_[n.node] : places_[near_], to = place(n.place);
    for (std::size_t i : {0, 1}) put_signed(std::int64_t(to[i]) - std::int64_t(from[i]));
    before = n.node;
  }
  // Only now: places are relative to what the last step has left.
  for (const FrontStep::Node& n : moved_) places_[n.node] = place(n.place), seen_[n.node] = true;
}

void FilmRecorder::put_faces(std::span<const FrontStep::Face> faces) {
  if (!faces.empty() && faces.back().face >= faces_.size()) faces_.resize(faces.back().face + 1, kNoFace);
  changed_.clear();
  for (const FrontStep::Face& f : faces)
    if (f.corners != faces_[f.face]) changed_.push_back(f);
  put(changed_.size());
  Index before = 0;
  for (const FrontStep::Face& f : changed_) {
    faces_[f.face] = f.corners;
    put_signed(std::int64_t(f.face) - std::int64_t(before));
    const Index corners = count_corners(f.corners);
    put(corners);
    for (Index i = 0; i < corners; ++i) put_near(f.corners[i]);
    before = f.face;
  }
}

void FilmRecorder::put_levels(std::span<const FrontEdge> edges) {
  leveled_.clear();
  for (const FrontEdge& e : edges) {
    if (e.edge >= levels_.size()) levels_.resize(e.edge + 1 + e.edge / 2);
    Level& last = levels_[e.edge];
    if (e.origin == last.origin && e.target == last.target && e.level == last.level) continue;
    last = {e.origin, e.target, e.level};
    leveled_.push_back(e);
  }
  put(leveled_.size());
  for (const FrontEdge& e : leveled_) {
    put_near(e.origin);
    put_near(e.target);
    put(e.level);
  }
}

}  // namespace qmorph::report
