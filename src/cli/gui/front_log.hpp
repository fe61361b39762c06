// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The steps of a surface's fronts, kept while they run and played in either direction afterwards.

#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "qmorph/observer.hpp"

namespace qmorph::cli {

/// All steps of one front.
class FrontLog : public FrontObserver {
 public:
  struct Step {
    StepKind kind = StepKind::quad;
    Index base_origin = kNone, base_target = kNone;
    SideEdge left = SideEdge::front, right = SideEdge::front;
    bool met_front = false;
    unsigned swaps = 0;
    unsigned level = 0;  ///< of the base edge
    /// Where what it changed ends in the lists below; it begins where that of the step before ends.
    std::size_t nodes = 0, faces = 0, edges = 0, gone = 0;
  };

  explicit FrontLog(const FrontStart& start);
  void step(const FrontStep& step) override;

  FlatFrame frame;
  std::vector<Eigen::Vector2d> points;      ///< at the start
  std::vector<std::array<Index, 4>> faces;  ///< at the start
  std::vector<FrontEdge> edges;             ///< at the start
  std::vector<Step> steps;
  std::vector<FrontStep::Node> moved;
  std::vector<FrontStep::Face> changed;
  std::vector<FrontEdge> restated;  ///< new, or with another state
  std::vector<Index> gone;

 private:
  void note(const FrontEdge& edge);

  std::map<Index, FrontEdge> now_;                        ///< by number
  std::map<std::pair<Index, Index>, unsigned> level_of_;  ///< by ends
};

/// A front as it is after some of its steps.
class FrontState {
 public:
  explicit FrontState(const FrontLog& log) : log_(log) { rewind(); }
  void rewind();
  /// \pre not at the end
  void advance();
  std::size_t position() const { return position_; }
  bool at_end() const { return position_ == log_.steps.size(); }

  const FrontLog& log() const { return log_; }
  const std::vector<std::array<Index, 4>>& faces() const { return faces_; }
  const std::map<Index, FrontEdge>& edges() const { return edges_; }
  /// In the model.
  Eigen::Vector3d point(Index node) const;
  /// Faces that the last step has made or changed.
  bool is_new(Index face) const;

 private:
  const FrontLog& log_;
  std::size_t position_ = 0;
  std::vector<Eigen::Vector2d> points_;
  std::vector<std::array<Index, 4>> faces_;
  std::map<Index, FrontEdge> edges_;
};

/// Watches the fronts of one surface.
class FrontWatcher : public Observer {
 public:
  explicit FrontWatcher(int surface) : surface_(static_cast<std::size_t>(surface)) {}
  std::unique_ptr<FrontObserver> front_starts(const FrontStart& start) override;
  void front_kept(std::size_t surface, std::unique_ptr<FrontObserver> front) override;
  int surface() const { return static_cast<int>(surface_); }
  std::vector<std::unique_ptr<FrontLog>> take() { return std::move(logs_); }

 private:
  const std::size_t surface_;
  std::vector<std::unique_ptr<FrontLog>> logs_;
};

/// The fronts of a surface, one after another.
class FrontPlayer {
 public:
  FrontPlayer(int surface, std::vector<std::unique_ptr<FrontLog>> logs);

  int surface() const { return surface_; }
  std::size_t count() const { return count_; }
  std::size_t position() const { return position_; }
  void go_to(std::size_t position);
  /// The end of the row that the next step belongs to, or the beginning of the one of the last step.
  std::size_t row_end() const;
  std::size_t row_begin() const;

  const std::vector<FrontState>& fronts() const { return states_; }
  /// The front of the last step. Null at the beginning.
  const FrontState* last() const;
  /// What the last step was, in words.
  std::string words() const;

 private:
  /// Front and step of a position.
  std::pair<std::size_t, std::size_t> find(std::size_t position) const;
  const FrontLog::Step& step(std::size_t position) const;
  bool same_row(std::size_t a, std::size_t b) const;

  int surface_;
  std::vector<std::unique_ptr<FrontLog>> logs_;
  std::vector<FrontState> states_;
  std::vector<std::size_t> ends_;  ///< of each front, as positions
  std::size_t count_ = 0, position_ = 0;
};

}  // namespace qmorph::cli
