// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One try at making quads of a region of a curved surface, and what the next one has to know of it.

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "chart/divide_region.hpp"
#include "chart/window_work.hpp"
#include "chart/windows.hpp"
#include "chart/work_on_region.hpp"
#include "engine/budget.hpp"
#include "qmorph/error.hpp"
#include "space/improve.hpp"

namespace qmorph::chart {

/// What everything that is not counted costs a try for each triangle: to divide, to flatten, to settle.
inline constexpr std::size_t kWorkToBegin = 120;
/// With more elements turned over than this, the fault is not one of single places.
inline constexpr std::size_t kFewTurned = 4;
/// With more than this in a region that is not large, another try has failed as well, as good as always. Where parts
/// have no chart, some elements in a thousand are turned over, so that large regions fail with fewer.
inline constexpr std::size_t kManyTurned = 24;
/// Up to so many triangles a region is worth more tries: a doubtful element is worth another one.
inline constexpr std::size_t kSmallRegion = 5000;

/// Whether a region has so many elements turned over before anything is improved that as many are so in the end, while
/// what comes in between is most of the work.
inline bool are_hopeless(std::size_t turned, std::size_t triangles) {
  constexpr double kShare = 0.001;
  return triangles > kSmallRegion && double(turned) > double(kManyTurned) + kShare * double(triangles);
}

/// Where a try has failed, by triangle of the region.
struct Distrust {
  std::vector<char> triangles;
  bool interfaces = false;  ///< straight ones were too much
  bool all = false;
  int refinings = 0;  ///< there are too few nodes
  /// Elements that the best try has left turned over.
  std::size_t fewest_turned = std::numeric_limits<std::size_t>::max();
};

/// Cuts the region into parts that lie flat, works on each in its chart, joins them, cleans the interfaces, and smooths
/// and mends in space. What it is made of must outlive it.
class RegionTry {
 public:
  RegionTry(const CurvedRegion& region, const Options& options, Budget& budget, Task task, const Distrust& distrust,
            SharedDivision& shared, Tries tries = Tries::as_many_as_pay);

  /// False if it failed.
  bool run();
  /// Once. \pre it did not fail
  RegionWork result();

  /// Of the elements of the result, or of what failed.
  std::size_t doubtful() const { return faults_.doubtful.size(); }
  std::size_t turned() const { return faults_.turned.size(); }
  /// Why it failed.
  std::optional<SurfaceError> find_fault() const;

  /// Adds what is under the faces that failed. False if that was distrusted already.
  bool learn(Distrust& distrust) const;

 private:
  using WindowWork = WindowResult (*)(const LaidOut& window, const Options& options, const Ground& ground,
                                      double allowed);

  const space::Background& background() const { return *region_.background; }
  SurfaceMesh started() const;

  /// Work for each use of windows. Ordinary surfaces take a tenth of it, a double torus that is cut all over a half;
  /// without what it needs at its cuts a surface gets smaller quads, and more tries.
  double window_allowance() const;

  /// Of all parts; interfaces and what space asks for need the rest. A try that has begun gets what it takes.
  double work_in_charts() const;

  /// What is refined here is as long as there were too few nodes.
  bool may_stretch() const { return task_ == Task::convert && options_.layers && distrust_.refinings == 0; }

  /// What begins with more elements turned over than another try has left is no better. If so, faults_ has them. On a
  /// surface that is smooth nearly everywhere nothing is turned over.
  bool is_hopeless();
  bool improve();
  bool improve_as_it_is();

  /// What nothing is distrusted of is the same for all fronts.
  void divide();

  const std::vector<std::vector<Index>>& parts() const { return divided_->division.parts; }
  const LaidOut& laid_out(std::size_t part) const { return *divided_->division.laid_out[part]; }
  bool is_distrusted(Index part) const;
  void work_on_parts();
  void note_stretched(const std::vector<char>& is_part_stretched);
  void pair_up_the_rest();

  /// The region as its parts were after a stage, or after the last one before it that was run.
  SurfaceMesh at_stage(std::size_t stage, const std::vector<Record>& records) const;

  /// Interfaces were boundaries: irregular nodes beside them cancel now, and rows run straight on.
  void clean_interfaces();

  /// True if it has changed the mesh. Windows cover all of it soon: where it is large, or has few irregular nodes, they
  /// cost more than they are worth.
  bool cancel_irregular_nodes();

  /// True if a window has changed.
  bool work_in_windows(std::vector<char> waiting, const WindowSize& size, WindowWork work, double most);

  const CurvedRegion& region_;
  Options options_;
  Budget& budget_;
  const Task task_;
  const Distrust& distrust_;
  SharedDivision& shared_;
  const Tries tries_;
  const Ground ground_;
  RegionWork work_;
  SurfaceMesh mesh_;
  std::shared_ptr<const DividedRegion> divided_;
  std::vector<char> has_no_chart_;    ///< by part
  std::vector<char> needs_cleaning_;  ///< by node: of parts without a chart
  std::vector<char> stretched_;       ///< by triangle of the region; empty if none is
  space::Faults faults_;
};

}  // namespace qmorph::chart
