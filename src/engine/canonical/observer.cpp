// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/canonical/observer.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace qmorph::canonical {
namespace {

// In a mirror the triangles ahead of an edge are on the left of the edge's other direction.

Eigen::Vector2d mirrored(const Eigen::Vector2d& p) { return {p.x(), -p.y()}; }

std::array<Index, 4> mirrored(std::array<Index, 4> corners) {
  const auto last = corners[3] == kNone ? corners.end() - 1 : corners.end();
  if (corners[0] != kNone) std::reverse(corners.begin() + 1, last);
  return corners;
}

FrontEdge mirrored(FrontEdge edge) {
  std::swap(edge.origin, edge.target);
  std::swap(edge.origin_corner, edge.target_corner);
  return edge;
}

FrontStep::Node mirrored(const FrontStep::Node& node) { return {node.node, mirrored(node.place)}; }
FrontStep::Face mirrored(const FrontStep::Face& face) { return {face.face, mirrored(face.corners)}; }

template <class T>
std::vector<T> mirrored(std::span<const T> all) {
  std::vector<T> result;
  result.reserve(all.size());
  for (const T& one : all) result.push_back(mirrored(one));
  return result;
}

/// Tells of each step what it is in a mirror.
class MirroredFront : public FrontObserver {
 public:
  explicit MirroredFront(std::unique_ptr<FrontObserver> front) : front_(std::move(front)) {}

  void step(const FrontStep& step) override {
    const auto nodes = mirrored(step.nodes);
    const auto faces = mirrored(step.faces);
    const auto edges = mirrored(step.edges), restated = mirrored(step.restated);
    FrontStep told = step;
    std::swap(told.base_origin, told.base_target);
    std::swap(told.left, told.right);
    told.nodes = nodes;
    told.faces = faces;
    told.edges = edges;
    told.restated = restated;
    front_->step(told);
  }
  std::unique_ptr<FrontObserver> take() { return std::move(front_); }

 private:
  std::unique_ptr<FrontObserver> front_;
};

}  // namespace

std::unique_ptr<FrontObserver> FrameObserver::front_starts(const FrontStart& start) {
  FrontStart told = start;
  told.frame.origin = frame_.to_model(start.frame.origin);
  told.frame.axis_u = frame_.direction_to_model(start.frame.axis_u);
  told.frame.axis_v = frame_.direction_to_model(start.frame.axis_v);
  std::vector<Eigen::Vector3d> places;
  for (const auto& place : start.places) places.push_back(frame_.to_model(place));
  told.places = places;
  if (!frame_.turns_over) return observer_.front_starts(told);
  told.frame.axis_v = -told.frame.axis_v;
  const auto points = mirrored(start.points);
  const auto faces = mirrored(start.faces);
  const auto edges = mirrored(start.edges);
  told.points = points;
  told.faces = faces;
  told.edges = edges;
  auto front = observer_.front_starts(told);
  return front ? std::make_unique<MirroredFront>(std::move(front)) : nullptr;
}

std::unique_ptr<FrontObserver> FrameObserver::callers(std::unique_ptr<FrontObserver> front) const {
  return frame_.turns_over ? static_cast<MirroredFront&>(*front).take() : std::move(front);
}

}  // namespace qmorph::canonical
