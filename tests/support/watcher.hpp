// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// An observer that records everything.

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "qmorph/observer.hpp"

namespace qmorph::test {

/// Applies the steps that it is told.
class FrontPlayer : public FrontObserver {
 public:
  explicit FrontPlayer(const FrontStart& start)
      : surface(start.surface),
        frame(start.frame),
        points(start.points.begin(), start.points.end()),
        faces(start.faces.begin(), start.faces.end()) {
    for (const FrontEdge& edge : start.edges) front[edge.edge] = edge;
  }

  void step(const FrontStep& step) override {
    ++kinds[step.kind];
    for (const FrontStep::Node& n : step.nodes) {
      if (n.node >= points.size()) points.resize(n.node + 1, Eigen::Vector2d::Zero());
      points[n.node] = n.place;
    }
    for (const FrontStep::Face& f : step.faces) {
      if (f.face >= faces.size()) faces.resize(f.face + 1, {kNone, kNone, kNone, kNone});
      faces[f.face] = f.corners;
    }
    for (Index edge : step.gone) is_consistent = front.erase(edge) == 1 && is_consistent;
    for (const auto& edges : {step.edges, step.restated})
      for (const FrontEdge& edge : edges) front[edge.edge] = edge;
    if (checks_each_step) check_front();
  }

  /// The front by faces alone: sides of triangles without a triangle on the other side.
  void check_front() {
    std::set<std::pair<Index, Index>> sides, told;
    for (const auto& f : faces)
      if (f[0] != kNone && f[3] == kNone)
        for (std::size_t i = 0; i < 3; ++i) sides.emplace(f[i], f[(i + 1) % 3]);
    for (const auto& [number, edge] : front) told.emplace(edge.origin, edge.target);
    for (auto side = sides.begin(); side != sides.end();)
      side = sides.contains({side->second, side->first}) ? (sides.erase({side->second, side->first}), sides.erase(side))
                                                         : std::next(side);
    is_consistent = is_consistent && sides == told;
  }

  std::size_t surface;
  FlatFrame frame;
  std::vector<Eigen::Vector2d> points;
  std::vector<std::array<Index, 4>> faces;
  std::map<Index, FrontEdge> front;
  std::map<StepKind, int> kinds;
  bool checks_each_step = false, is_consistent = true;
};

class Watcher : public Observer {
 public:
  struct StageNote {
    std::size_t surface;
    Stage stage;
    QuadMesh mesh;
    Eigen::Vector3d normal;
    std::vector<double> size_ratios;
  };
  struct FrontNote {
    std::size_t surface;
    std::unique_ptr<FrontObserver> front;
    const FrontPlayer& player() const { return static_cast<const FrontPlayer&>(*front); }
  };

  std::unique_ptr<FrontObserver> front_starts(const FrontStart& start) override {
    ++started;
    return std::make_unique<FrontPlayer>(start);
  }
  void front_kept(std::size_t surface, std::unique_ptr<FrontObserver> front) override {
    fronts.push_back({surface, std::move(front)});
  }
  bool wants_stages() const override { return true; }
  void stage_done(const StageView& view) override {
    stages.push_back(
        {view.surface, view.stage, view.mesh, view.normal, {view.size_ratios.begin(), view.size_ratios.end()}});
  }

  std::atomic<int> started = 0;
  std::vector<FrontNote> fronts;
  std::vector<StageNote> stages;
};

/// Corners in order from the smallest.
inline std::array<Index, 4> turned(std::array<Index, 4> face) {
  const auto end = face[3] == kNone ? face.begin() + 3 : face.end();
  std::rotate(face.begin(), std::min_element(face.begin(), end), end);
  return face;
}

inline std::set<std::array<Index, 4>> live_faces(const std::vector<std::array<Index, 4>>& faces) {
  std::set<std::array<Index, 4>> live;
  for (const auto& face : faces)
    if (face[0] != kNone) live.insert(turned(face));
  return live;
}

}  // namespace qmorph::test
