// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Tells an observer what the front does.

#include <memory>
#include <vector>

#include "front/front.hpp"
#include "front/morph.hpp"
#include "kernel/mark_set.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/observer.hpp"

namespace qmorph::front {

/// What the steps say about themselves while they work. Kept whether anybody watches or not.
struct StepNotes {
  SideEdge left = SideEdge::front, right = SideEdge::front;
  SideEdge side = SideEdge::existing;  ///< of the last define_side_edge()
  unsigned swaps = 0;                  ///< of the last recover_edge()
  bool met_front = false;
};

/// A step that was taken.
struct TakenStep {
  StepKind kind;
  Index base_origin, base_target;
  const StepNotes& notes;
  const std::vector<Index>& restated;  ///< front edges whose states are new
};

class StepReporter {
 public:
  /// Asks the settings' observer who wants to see this front. `states` are those of all front edges, by half-edge.
  StepReporter(const kernel::Mesh& mesh, Front& front, const std::vector<State>& states, double corner_angle,
               const MorphSettings& settings);

  bool is_watched() const { return watcher_ != nullptr; }
  /// To be called after the commit of a step, with states as they are now. Cost: that of the step.
  void report(const TakenStep& step);
  std::unique_ptr<FrontObserver> finish() { return std::move(watcher_); }

 private:
  bool is_front(Index h) const { return mesh_.is_live_half_edge(h) && front_.contains(h); }
  FrontEdge edge(Index h) const;
  void collect_nodes();
  void collect_faces();
  void collect_edges();
  void look_at(Index h);

  const kernel::Mesh& mesh_;
  Front& front_;
  const std::vector<State>& states_;
  std::unique_ptr<FrontObserver> watcher_;
  std::vector<bool> was_front_;  ///< by half-edge
  // Of one step.
  kernel::MarkSet listed_;
  std::vector<Index> changed_, gone_;
  std::vector<FrontStep::Node> nodes_;
  std::vector<FrontStep::Face> faces_;
  std::vector<FrontEdge> edges_, restated_;
};

}  // namespace qmorph::front
