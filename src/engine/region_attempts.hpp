// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A region through the stages once, in several ways. Which of them are tried, and what is taken of them, is decided in
/// convert_region.cpp.

#include <cstddef>
#include <optional>

#include "engine/budget.hpp"
#include "engine/fronts_made.hpp"
#include "engine/pipeline.hpp"
#include "engine/regions.hpp"
#include "engine/worth.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/error.hpp"
#include "qmorph/options.hpp"
#include "qmorph/report.hpp"

namespace qmorph {

/// What the stages have made of a region so far.
struct Attempt {
  kernel::Mesh mesh;
  Options options{};
  double allowed = 0;     ///< work
  double promise = 0;     ///< what the mesh was worth when it was clean: nearly all about what it will be
  bool is_quick = false;  ///< so that cleaning is not done
  ConversionReport report{};
  Record record{};
  std::optional<SurfaceError> fault{};
};

/// How a mesh of quads comes about.
enum class Way { with_front, one_of_many, without_front };

/// So that other constants of the front may be tried for more than a poor result.
inline bool is_small(const Region& region, const Options& options) {
  return 2 * region.triangles.size() <= options.retry_triangles;
}

/// Makes attempts at a region, all from one budget.
class RegionAttempts {
 public:
  RegionAttempts(const Region& region, const Plane& plane, const Options& options, Budget& budget);

  /// Of the budget, for what comes after all attempts: begin() and left() do without it.
  void keep_back(double work);

  /// What the front begins with: the triangles, repaired, with fans graded.
  const kernel::Mesh& start() const { return start_; }
  /// The same, for the last that needs it.
  kernel::Mesh take_start() { return std::move(start_); }
  /// Triangles of start() for each of the region's.
  double growth_at_start() const { return graded_; }

  /// Up to where the mesh is clean. `mesh`: triangles, or quads if it is without a front. With a `fault` if the front
  /// has gone astray, or as one of many has made what another had made before.
  Attempt begin(kernel::Mesh mesh, const Options& options, double allowed, Way way = Way::with_front,
                bool is_quick = false);
  /// What begin() has left out because the front had gone astray.
  void clean_astray(Attempt& attempt);
  /// From there to the end. With a `fault` if the result is not valid.
  void finish(Attempt& attempt);

  /// begin() and finish() without a front: triangles paired as they are.
  Attempt pair_triangles();
  /// Where the triangles are a grid's, their cells; moved only if that makes the worst much better. Nothing if a cell
  /// is poor, or there is no grid.
  std::optional<Attempt> attempt_as_grid();
  /// Nothing if the region is not large, or has no valid result in parts.
  std::optional<Attempt> attempt_in_parts();

  /// Whether the front would make what it has made in another attempt.
  bool would_repeat(const FrontOptions& front) const { return fronts_.would_repeat(front); }

  /// Raises the corners that are not good enough, or as many as asked for if the others do not lose more by it; again
  /// where quads are still poor, since each time only a share of all elements counts as bad.
  void raise_corners(kernel::Mesh& mesh, const SmoothingOptions& smoothing) const;

  /// In the chart of a curved surface the worst quad says less: in space it will be another.
  Worth judge(const kernel::Mesh& mesh) const;

  bool is_small() const { return is_small_; }
  /// Work for all attempts together, what is left of it, and what they have cost.
  double allowed() const { return allowed_; }
  double left() const { return budget_.left() - kept_back_; }
  std::size_t cost() const { return cost_; }
  void spend(std::size_t work);
  /// However much the front has cost: rows come from a plan, and what a band is without them is hardly ever good.
  double left_for_rows() const;

 private:
  /// Makes the mesh that the front begins with.
  void prepare();
  /// Quads that there are without a front take its place among the stages.
  void note_cells(Attempt& attempt) const;
  /// Whether the mesh is worth more for it; if not, it stays.
  bool raise_corners_once(kernel::Mesh& mesh, const SmoothingOptions& smoothing) const;

  const Region& region_;
  const Plane& plane_;
  const Options& options_;
  const bool is_small_;
  Budget& budget_;
  double graded_ = 1;
  double kept_back_ = 0, allowed_ = 0;
  std::size_t cost_ = 0;
  FrontsMade fronts_;
  kernel::Mesh start_;
  kernel::Mesh input_;  ///< as it came, if stages are measured
};

}  // namespace qmorph
