// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/gui/front_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

namespace qmorph::cli {
namespace {

constexpr std::array kKinds = {"quad",
                               "the loop that was left of the front is closed",
                               "seam: two front edges at a sharp angle become one",
                               "transition seam: two front edges of very different length become one",
                               "transition split: a front edge much longer than its neighbour is split",
                               "refinement: a front edge much longer than those ahead is split"};
constexpr std::array kSides = {"front edge", "edge that was there", "swapped diagonal", "split of the opposite edge",
                               "edge to the front, halved"};

std::string name_of(SideEdge side) { return kSides[static_cast<std::size_t>(side)]; }

}  // namespace

FrontLog::FrontLog(const FrontStart& start)
    : frame(start.frame),
      points(start.points.begin(), start.points.end()),
      faces(start.faces.begin(), start.faces.end()),
      edges(start.edges.begin(), start.edges.end()) {
  for (const FrontEdge& edge : edges) note(edge);
}

void FrontLog::note(const FrontEdge& edge) {
  now_[edge.edge] = edge;
  level_of_[{edge.origin, edge.target}] = edge.level;
}

void FrontLog::step(const FrontStep& step) {
  Step kept{step.kind, step.base_origin, step.base_target, step.left, step.right, step.met_front, step.swaps};
  if (const auto base = level_of_.find({step.base_origin, step.base_target}); base != level_of_.end())
    kept.level = base->second;
  moved.insert(moved.end(), step.nodes.begin(), step.nodes.end());
  changed.insert(changed.end(), step.faces.begin(), step.faces.end());
  restated.insert(restated.end(), step.edges.begin(), step.edges.end());
  restated.insert(restated.end(), step.restated.begin(), step.restated.end());
  gone.insert(gone.end(), step.gone.begin(), step.gone.end());
  for (Index edge : step.gone)
    if (const auto found = now_.find(edge); found != now_.end()) {
      level_of_.erase({found->second.origin, found->second.target});
      now_.erase(found);
    }
  for (const FrontEdge& edge : step.edges) note(edge);
  for (const FrontEdge& edge : step.restated) note(edge);
  kept.nodes = moved.size(), kept.faces = changed.size(), kept.edges = restated.size(), kept.gone = gone.size();
  steps.push_back(kept);
}

void FrontState::rewind() {
  position_ = 0;
  points_ = log_.points;
  faces_ = log_.faces;
  edges_.clear();
  for (const FrontEdge& edge : log_.edges) edges_[edge.edge] = edge;
}

void FrontState::advance() {
  const FrontLog::Step before = position_ ? log_.steps[position_ - 1] : FrontLog::Step{};
  const FrontLog::Step& step = log_.steps[position_++];
  for (std::size_t i = before.nodes; i < step.nodes; ++i) {
    const FrontStep::Node& node = log_.moved[i];
    if (node.node >= points_.size()) points_.resize(node.node + 1);
    points_[node.node] = node.place;
  }
  for (std::size_t i = before.faces; i < step.faces; ++i) {
    const FrontStep::Face& face = log_.changed[i];
    if (face.face >= faces_.size()) faces_.resize(face.face + 1, {kNone, kNone, kNone, kNone});
    faces_[face.face] = face.corners;
  }
  for (std::size_t i = before.gone; i < step.gone; ++i) edges_.erase(log_.gone[i]);
  for (std::size_t i = before.edges; i < step.edges; ++i) edges_[log_.restated[i].edge] = log_.restated[i];
}

Eigen::Vector3d FrontState::point(Index node) const {
  const Eigen::Vector2d& p = points_[node];
  return log_.frame.origin + p.x() * log_.frame.axis_u + p.y() * log_.frame.axis_v;
}

bool FrontState::is_new(Index face) const {
  if (position_ == 0) return false;
  const std::size_t begin = position_ > 1 ? log_.steps[position_ - 2].faces : 0, end = log_.steps[position_ - 1].faces;
  return std::any_of(log_.changed.begin() + std::ptrdiff_t(begin), log_.changed.begin() + std::ptrdiff_t(end),
                     [&](const FrontStep::Face& changed) { return changed.face == face; });
}

std::unique_ptr<FrontObserver> FrontWatcher::front_starts(const FrontStart& start) {
  if (start.surface != surface_) return nullptr;
  return std::make_unique<FrontLog>(start);
}

void FrontWatcher::front_kept(std::size_t, std::unique_ptr<FrontObserver> front) {
  logs_.emplace_back(static_cast<FrontLog*>(front.release()));
}

FrontPlayer::FrontPlayer(int surface, std::vector<std::unique_ptr<FrontLog>> logs)
    : surface_(surface), logs_(std::move(logs)) {
  for (const auto& log : logs_) {
    states_.emplace_back(*log);
    ends_.push_back(count_ += log->steps.size());
  }
}

std::pair<std::size_t, std::size_t> FrontPlayer::find(std::size_t position) const {
  const auto front = static_cast<std::size_t>(std::upper_bound(ends_.begin(), ends_.end(), position) - ends_.begin());
  return {front, position - (front ? ends_[front - 1] : 0)};
}

const FrontLog::Step& FrontPlayer::step(std::size_t position) const {
  const auto [front, at] = find(position);
  return logs_[front]->steps[at];
}

void FrontPlayer::go_to(std::size_t position) {
  position_ = std::min(position, count_);
  for (std::size_t f = 0; f < states_.size(); ++f) {
    const std::size_t begin = f ? ends_[f - 1] : 0;
    const std::size_t wanted = std::clamp(position_, begin, ends_[f]) - begin;
    if (states_[f].position() > wanted) states_[f].rewind();  // a replay takes milliseconds
    while (states_[f].position() < wanted) states_[f].advance();
  }
}

bool FrontPlayer::same_row(std::size_t a, std::size_t b) const {
  return find(a).first == find(b).first && step(a).level == step(b).level;
}

std::size_t FrontPlayer::row_end() const {
  std::size_t end = std::min(position_ + 1, count_);
  while (end > position_ && end < count_ && same_row(position_, end)) ++end;
  return end;
}

std::size_t FrontPlayer::row_begin() const {
  if (position_ == 0) return 0;
  std::size_t begin = position_ - 1;
  while (begin > 0 && same_row(position_ - 1, begin - 1)) --begin;
  return begin;
}

const FrontState* FrontPlayer::last() const { return position_ ? &states_[find(position_ - 1).first] : nullptr; }

std::string FrontPlayer::words() const {
  if (count_ == 0) return "no front was needed here";
  if (position_ == 0) return "the triangles before the first step";
  const FrontLog::Step& s = step(position_ - 1);
  std::string text = kKinds[static_cast<std::size_t>(s.kind)];
  if (s.kind != StepKind::quad) return text;
  text += s.left == s.right
              ? fmt::format(" of row {}; both sides: {}", s.level + 1, name_of(s.left))
              : fmt::format(" of row {}; left: {}, right: {}", s.level + 1, name_of(s.left), name_of(s.right));
  text += s.swaps ? fmt::format("; top edge by {} swap{}", s.swaps, s.swaps == 1 ? "" : "s") : "; top edge was there";
  return text + (s.met_front ? "; it meets the front" : "");
}

}  // namespace qmorph::cli
