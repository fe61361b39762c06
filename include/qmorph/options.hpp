// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Every number of the algorithm that a caller may want to change. Angles are in radians, times in seconds; lengths are
/// never absolute: they are relative to edges nearby, and have no unit.

#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "qmorph/export.hpp"

namespace qmorph {

class Observer;

/// Constants of the advancing front.
struct FrontOptions {
  /// An end of a front edge is a corner (state bit 1) below this angle. Thesis 2.2.2.
  double corner_angle = 0.75 * std::numbers::pi;
  /// Two front edges are seamed below this angle; `seam_angle_many` where 5 quads or more meet. Thesis 2.2.4, table
  /// 4.1.
  double seam_angle = 0.25 * std::numbers::pi;
  double seam_angle_many = 0.15 * std::numbers::pi;
  /// Neighbouring front edges whose lengths differ by more than this factor are a transition. Thesis 2.2.4.
  double transition_ratio = 2.5;
  /// A side edge may be this far from its ideal direction. [Owen99]
  double side_edge_angle = std::numbers::pi / 6;
  /// A side edge made by a swap may be as long as this times the sum of its two front edges. [Owen99]
  double side_edge_length = 0.8660254037844386;
};

/// Constants of topological cleanup.
struct CleanupOptions {
  /// A quad with a larger angle is a chevron. Thesis 3.6.1, 4.1.11 (200 degrees there, for want of stability).
  double chevron_angle = std::numbers::pi;
  /// The cases of the thesis (3.6, appendix): rounds of them, and which take part. Measured on 33 planar meshes of Gmsh
  /// (87 thousand quads): alone they bring the irregular nodes from 14.4 % to 10.1 %, cavities and changes by score
  /// (cleanup/clean_up.hpp) alone to 2.4 %. Beside those, transitions and large angles raise the mean scaled Jacobian
  /// of the thesis' models from 0.812 to 0.819, and diamonds the smallest one of geo/ from 0.38 to 0.47 where a passage
  /// is narrow: on. Tables 1 to 3 of the appendix find nothing there any more: off.
  int pattern_rounds = 3;
  bool transition_cases = true, shape_cases = true, diamond_cases = true;
  bool connectivity_cases = false, boundary_cases = false;
  /// A quad with both its edges at a node on the boundary and a larger angle there is triangularly shaped. Thesis
  /// 3.6.4.
  double transition_angle = 0.75 * std::numbers::pi;
  /// A quad with a larger angle is combined with a neighbour. Thesis 3.6.5.
  double shape_angle = 8 * std::numbers::pi / 9;
};

/// Constants of the thesis' smoothing (table 4.1), under its names where a command sets them. Lengths are relative
/// here; there they were absolute.
struct ThesisSmoothing {
  /// THETAMAX: a move that leaves a larger angle is refused. 4.1.6
  double largest_angle = 10 * std::numbers::pi / 9;
  /// MYMIN: below this metric an element is poor; a move may not make the mean worse by more. 4.1.5
  double least_quality = 0.05;
  /// OBSTOL: nodes of elements with a smaller metric are optimised after two Laplacian moves. 4.1.7
  double optimise_below = 0.1;
  /// DELTAFACTOR: differences for gradients are this times the longest edge at the node. 4.1.4
  double delta_factor = 1e-5;
  /// GAMMA: where no element limits the step of steepest descent, it is this times the shortest edge at the node. 4.1.8
  double gamma = 0.8;
  /// TOL: by how much an optimising step must raise the smallest metric. 4.1.9
  double least_gain = 1e-5;
  /// MAXITER: passes. 4.1.10
  int most_passes = 5;
  /// MOVETOLERANCE: shorter moves, relative to the mean edge at the node, are not made. 4.1.3
  double move_tolerance = 0.01;
  /// COINCTOL: nodes of an element nearer than this times its longest side coincide. 4.1.2
  double coincidence = 0.01;
};

/// How nodes are moved. Measured on 33 planar meshes of Gmsh, shape_energy and thesis: scaled Jacobian min 0.35 and
/// 0.25, mean 0.969 and 0.967, mean of the 1st percentiles 0.79 and 0.76, quads under 0.3 none and 64, irregular nodes
/// 2.5 and 2.6 %, seconds of all stages 1.1 and 1.9. With MAXITER 50 and MOVETOLERANCE 0.001 the thesis' is hardly
/// better.
enum class SmoothingMethod {
  shape_energy,  ///< Newton steps on a shape energy, then on the worst corners
  thesis,        ///< constrained Laplacian, then steepest descent on the worst element. Thesis 2.2.6, 3.7
};

/// Constants of smoothing and repair.
struct SmoothingOptions {
  /// Of the smoothing of the whole mesh; what cleanup relaxes around a change always uses the energy.
  SmoothingMethod method = SmoothingMethod::shape_energy;
  ThesisSmoothing thesis;
  int iterations = 4;            ///< passes over the nodes that are still active
  double move_tolerance = 0.01;  ///< a move shorter than this times the local edge length ends a node's activity
  int untangling_sweeps = 40;    ///< passes of the regularised energy over a patch with invalid elements
  double good_quality = 0.75;    ///< corners with a smaller sine are raised in the end, at the cost of better ones
  double target_quality = 0.3;   ///< elements with a smaller scaled Jacobian are optimised one node at a time
};

/// Whether the work is to go on.
enum class Progress { go_on, cancel };

/// Gets the name of a stage that is at work and the share of all that is done, 0 to 1: one call at a time, but not
/// always from the same thread. With `cancel` the work ends at the next look of each thread, in general within a stage,
/// and `Cancelled` is thrown. An exception of the callback's own ends the work in the same way and comes out unchanged.
/// In both cases nothing is left of the conversion; a Gmsh model has the mesh that it had.
using ProgressCallback = std::function<Progress(std::string_view stage, double share)>;

/// All options of one conversion.
struct Options {
  FrontOptions front;
  CleanupOptions cleanup;
  SmoothingOptions smoothing;
  /// Pairs of triangles in boundary layers, structured strips and grids become the quads that they are halves of; the
  /// front works on the rest. Where triangles are stretched otherwise, quads are stretched as these are.
  bool layers = true;
  /// Small regions whose result is poor are converted again with other constants of the front, as long as all tries
  /// together take no more triangles than this, or than six times its own where a region of up to twice as many has a
  /// quad with a scaled Jacobian under 0.7; the best result counts. In the plane it is changed quad by quad then, as
  /// long as that pays. 0: never.
  std::size_t retry_triangles = 2000;
  /// A region of many triangles is cut into parts of about so many, which are worked on side by side and joined in the
  /// end; not if it has less than 1.5 times as many. The result depends on it, but not on the number of threads. 0:
  /// never.
  std::size_t part_triangles = 120'000;
  /// On a curved surface, edges whose triangles meet at a larger angle (radians, between their normals) are kept. 180
  /// degrees: none.
  double crease_angle = 2 * std::numbers::pi / 9;
  /// Check what every operation has made, and in the front the whole mesh: slow, for tests.
  bool check_each_step = false;
  /// Threads at most; 0: as many as the machine has. The result does not depend on it.
  int threads = 0;
  /// Called from time to time; may be empty.
  ProgressCallback progress;
  /// Watches how the result comes about (observer.hpp); may be null. It must outlive the call that it watches.
  Observer* observer = nullptr;
};

/// Sets one number by its name, as `--set NAME=VALUE` of the command does: the constants of the thesis by the thesis'
/// names, others as "cleanup.pattern_rounds". Angles are in degrees here, switches are 0 or 1.
/// \throws UsageError if there is no such name or the value is out of range
QMORPH_API void set_option(Options& options, std::string_view name, double value);

/// What `set_option` would set, in the same units. \throws UsageError if there is no such name
QMORPH_API double get_option(const Options& options, std::string_view name);

/// The names that both know.
QMORPH_API std::vector<std::string> option_names();

}  // namespace qmorph
