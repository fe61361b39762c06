// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How a front advanced, step by step, small enough to keep: about 100 bytes a quad.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "qmorph/index.hpp"
#include "qmorph/observer.hpp"

namespace qmorph::report {

/// One region's front. A point (x, y) of the film is `origin + x * axis_u + y * axis_v` in the model, if it is planar.
///
/// `bytes` holds the steps one after another. Numbers are LEB128 (seven bits a byte, lowest first, the high bit says
/// that more follow); `s` marks signed ones, written as 2n or -2n - 1. "near" is the origin of the step's base edge:
///   u8 StepKind
///   only of a quad: u8 SideEdge left + 8 * SideEdge right + 64 if a side edge met the front, number of swaps for the
///   top edge
///   the base edge: its origin, s target - origin
///   count, then for each node that moved or is new: s node - the one before (near, for the first), s dx, s dy from
///   where
///     it was last; from near, of a node never seen
///   count, then for each face that changed: s face - the one before (0 for the first), its number of corners (0:
///   gone), for
///     each corner s node - near
///   count, then for each front edge that has a new level: s origin - near, s target - near, level
struct Film {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_u = Eigen::Vector3d::UnitX(), axis_v = Eigen::Vector3d::UnitY();
  /// Of a curved surface: where `points` are in the model. Others lie in the triangles at the start, each flat.
  std::vector<Eigen::Vector3d> places;
  double corner_angle = 0;                          ///< an end of a front edge is a corner below it, in radians
  std::vector<std::array<std::int32_t, 2>> points;  ///< at the start
  std::vector<std::array<Index, 4>> faces;  ///< at the start; of a triangle the last is kNone, of no face the first
  std::size_t steps = 0;
  std::vector<std::uint8_t> bytes;
};

/// Writes a film while the front runs.
class FilmRecorder : public FrontObserver {
 public:
  explicit FilmRecorder(const FrontStart& start);

  /// Cost: that of the step.
  void step(const FrontStep& step) override;
  Film finish() { return std::move(film_); }

 private:
  struct Level {
    Index origin = kNone, target = kNone;
    unsigned level = 0;
  };
  using Place = std::array<std::int32_t, 2>;

  Place place(const Eigen::Vector2d& point) const;
  void put(std::uint64_t number);
  void put_signed(std::int64_t number);
  void put_near(Index v) { put_signed(std::int64_t(v) - std::int64_t(near_)); }
  void put_nodes(std::span<const FrontStep::Node> nodes);
  void put_faces(std::span<const FrontStep::Face> faces);
  void put_levels(std::span<const FrontEdge> edges);

  Film film_;
  Eigen::Vector2d corner_;
  double quantum_;
  std::vector<Place> places_;  ///< as last written
  std::vector<bool> seen_;
  std::vector<std::array<Index, 4>> faces_;
  std::vector<Level> levels_;
  std::vector<FrontStep::Node> moved_;
  std::vector<FrontStep::Face> changed_;
  std::vector<FrontEdge> leveled_;
  Index near_ = 0;
};

}  // namespace qmorph::report
