#pragma once
/// Every number of the algorithm that a caller may want to change. Angles are in radians; lengths are
/// never absolute.

#include <functional>
#include <numbers>
#include <string_view>

namespace qmorph {

/// Constants of the advancing front.
struct FrontOptions {
  /// An end of a front edge is a corner (state bit 1) below this angle. Thesis 2.2.2.
  double corner_angle = 0.75 * std::numbers::pi;
  /// Two front edges are seamed below this angle; `seam_angle_many` where 5 quads or more meet. Thesis 2.2.4, table 4.1.
  double seam_angle = 0.25 * std::numbers::pi;
  double seam_angle_many = 0.15 * std::numbers::pi;
  /// Neighbouring front edges whose lengths differ by more than this factor are a transition. Thesis 2.2.4.
  double transition_ratio = 2.5;
  /// A side edge may be this far from its ideal direction. [Owen99]
  double side_edge_angle = std::numbers::pi / 6;
  /// A swapped side edge may be this times the sum of its two front edges. [Owen99]
  double side_edge_length = 0.8660254037844386;
};

/// Constants of smoothing and repair.
struct SmoothingOptions {
  int iterations = 8;               ///< passes over the nodes that are still active
  double move_tolerance = 1e-3;     ///< a move shorter than this times the local edge length ends a node's activity
  int untangling_sweeps = 40;       ///< passes of the regularised energy over a patch with invalid elements
  double good_quality = 0.75;       ///< corners with a smaller sine are raised in the end, at the cost of better ones
  double target_quality = 0.3;      ///< elements with a smaller scaled Jacobian are optimised one node at a time
};

/// All options of one conversion.
struct Options {
  FrontOptions front;
  SmoothingOptions smoothing;
  bool check_each_step = false;     ///< validate the mesh after every step: slow, for tests
  bool measure_stages = false;      ///< `ConversionStats::stages` is filled: a copy of the mesh and a measurement a stage
  /// Called now and then with the stage's name and the share done (0 to 1). May be empty.
  std::function<void(std::string_view stage, double share)> progress;
};

}  // namespace qmorph
