// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How a result comes about, for those who want to watch: each step of the advancing front, and the surface after each
/// stage. It costs nothing while nobody watches, and changes no result.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "qmorph/export.hpp"
#include "qmorph/index.hpp"
#include "qmorph/patch.hpp"

namespace qmorph {

// --- the front, step by step ----------------------------------------------------------------------------

/// What a step of the front did (thesis 2.2.3, 2.2.4).
enum class StepKind {
  quad,              ///< a quad on a base edge
  small_loop,        ///< what remained of the front, a loop of four or six edges, was closed
  seam,              ///< two front edges were sewn together
  transition_seam,   ///< two of very different length
  transition_split,  ///< a front edge much longer than its neighbour was split
  refinement,        ///< a front edge much longer than the input's edges ahead was split
};

/// Where a side edge of a quad came from.
enum class SideEdge {
  front,     ///< it was a front edge already
  existing,  ///< an edge near the ideal direction
  swapped,   ///< a diagonal was turned
  split,     ///< the edge opposite was split
  halved,    ///< an edge to another part of the front, cut in two so that no odd loop is left
};

/// Where the front works: a point (x, y) of it is `origin + x * axis_u + y * axis_v` in the model. The axes have length
/// 1.
struct FlatFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_u = Eigen::Vector3d::UnitX(), axis_v = Eigen::Vector3d::UnitY();
};

/// An edge of the front. The triangles ahead lie on its left.
struct FrontEdge {
  Index edge = kNone;  ///< its number while it is on the front
  Index origin = kNone, target = kNone;
  unsigned level = 0;                                 ///< rows of quads between it and the boundary
  bool origin_corner = false, target_corner = false;  ///< its state: which of its ends are corners (thesis 2.2.2)
};

/// A front before its first step. Numbers of nodes, faces and edges are this front's own, and may be used again for
/// others when what had them is gone. Spans are valid during the call.
struct FrontStart {
  std::size_t surface = 0;  ///< row of the patches of convert_all(), 0 for convert(); in a Gmsh model its tag
  FlatFrame frame;
  double corner_angle = 0;                  ///< an end of a front edge is a corner below it, in radians
  std::span<const Eigen::Vector2d> points;  ///< by node; NaN where there is none
  /// Of a curved surface: where the nodes are in the model, which no frame says. Empty for planar ones.
  std::span<const Eigen::Vector3d> places;
  /// By number: corners counter-clockwise; of a triangle the last is kNone, where there is no face the first.
  std::span<const std::array<Index, 4>> faces;
  std::span<const FrontEdge> edges;
};

/// One step, and what is different after it. Spans are valid during the call.
struct FrontStep {
  struct Node {
    Index node = kNone;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
  };
  struct Face {
    Index face = kNone;
    std::array<Index, 4> corners{};  ///< as in `FrontStart::faces`
  };
  StepKind kind = StepKind::quad;
  Index base_origin = kNone, base_target = kNone;            ///< the base edge, as it was before the step
  SideEdge left = SideEdge::front, right = SideEdge::front;  ///< of a quad: the side edges at origin and target
  bool met_front = false;                                    ///< of a quad: a side edge met another part of the front
  unsigned swaps = 0;                                        ///< of a quad: edges turned for its top edge
  std::span<const Node> nodes;                               ///< new or moved, maybe by nothing, in ascending order
  std::span<const Face> faces;                               ///< new, changed or gone, in ascending order
  std::span<const FrontEdge> edges;     ///< what is new on the front or borders on what has changed
  std::span<const FrontEdge> restated;  ///< front edges whose states were looked at again
  std::span<const Index> gone;          ///< numbers of edges that are not on the front any more
};

/// Sees the steps of one front, one after another, at the end of each.
class QMORPH_API FrontObserver {
 public:
  virtual ~FrontObserver() = default;
  virtual void step(const FrontStep& step) = 0;
};

// --- the surface after each stage -----------------------------------------------------------------------

/// The stages in their order. `input` is the mesh before all of them; `smoothing` the rough one by which cleanup
/// judges.
enum class Stage { input, front, elimination, smoothing, cleanup, final_smoothing, repair };
inline constexpr std::size_t kStages = 7;

/// "final smoothing"
QMORPH_API const char* name_of(Stage stage);

/// A surface after a stage; after one that was not run it is as after the one before. Valid during the call.
struct StageView {
  std::size_t surface = 0;  ///< as in `FrontStart`
  Stage stage = Stage::input;
  double seconds = 0;  ///< of the stage alone, all regions together
  const QuadMesh& mesh;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit normal of its plane; zero if it is curved
  /// Of the last stage: for each inner edge, its length over that of the input's edges nearby (the median of the 12
  /// whose middles are nearest).
  std::span<const double> size_ratios;
};

// --- who watches ----------------------------------------------------------------------------------------

/// `Options::observer`. What it throws comes out of the call that it watches, as with `Options::progress`.
class QMORPH_API Observer {
 public:
  virtual ~Observer() = default;

  /// A front is about to start: of a region, or of what layers leave of it, of a part of a large region, or of a small
  /// region once more with other constants. The observer that is returned sees its steps; null: none does. Fronts run
  /// side by side: may be called from several threads at a time.
  virtual std::unique_ptr<FrontObserver> front_starts(const FrontStart&) { return nullptr; }

  /// Of the fronts of a surface, those whose quads the result was made from; the others' observers are destroyed. This
  /// and stage_done() are called in the end, in the order of the surfaces, by the thread that called the library; never
  /// for a surface that could not be converted.
  virtual void front_kept(std::size_t /*surface*/, std::unique_ptr<FrontObserver>) {}

  /// Whether stage_done() is to be called, which takes a copy of the mesh for each stage.
  virtual bool wants_stages() const { return false; }
  virtual void stage_done(const StageView&) {}
};

}  // namespace qmorph
