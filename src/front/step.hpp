// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What every step of the advancing front works on. A step either succeeds or reports that it did not; the driver
/// runs each in a transaction of the mesh, so a step that gives up half-way has changed nothing.

#include <array>
#include <span>
#include <vector>

#include "front/front.hpp"
#include "front/loop_colours.hpp"
#include "front/step_reporter.hpp"
#include "kernel/mark_set.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::front {

struct Step {
  kernel::Mesh& mesh;
  Front& front;
  LoopColours& colours;
  const FrontOptions& options;
  LoggedColumn<double> size;       ///< edge length that the input has at a node
  std::vector<Index> moved;        ///< nodes that the step moved or created
  Decisions* decisions = nullptr;  ///< is told what the constants have decided; may be null

  // Scratch space, kept to avoid allocations.
  std::vector<Index> scratch{};
  kernel::MarkSet marked{};

  StepNotes notes{};  ///< for those who watch
};

// --- side edges: side_edge.cpp ----------------------------------------------------------------------------

/// One end of the base edge: the front edges that meet there and the ideal direction of the side edge.
struct Corner {
  Index incoming;      ///< front edge into the node
  Index outgoing;      ///< front edge out of the node
  double ideal_angle;  ///< from `outgoing`, counter-clockwise
};
/// What a side edge must leave alone: the other side's far node and edge.
struct Taken {
  Index node = kNone;
  Index half_edge = kNone;
};
/// A half-edge from the corner's node to the far node of a side edge: an edge that is there, or one made by
/// a swap or a split. kNone if none is possible. Thesis 2.2.3, [Owen99] "side edge definition".
Index define_side_edge(Step& step, const Corner& corner, const Taken& taken);

// --- edge_recovery.cpp ------------------------------------------------------------------------------------

/// Makes the segment from origin(h) to v an edge by swapping the edges that it crosses; the segment leaves
/// origin(h) counter-clockwise of h. Returns the half-edge origin(h) -> v, or kNone if a front edge,
/// a quad or a node is in the way. [Owen99] algorithms 1 and 2.
Index recover_edge(Step& step, Index h, Index v);

// --- quad_formation.cpp -----------------------------------------------------------------------------------

/// Replaces the triangles inside a ring of half-edges (interior on their left) by one face; kNone if
/// there is a hole, a quad or a fixed node inside.
Index form_face(Step& step, std::span<const Index> ring, std::size_t most_triangles);

// --- seam.cpp, transition.cpp -------------------------------------------------------------------------------

/// Sews the front edges `incoming` and `outgoing` together, which meet at a sharp angle. Thesis 2.2.4.
bool seam(Step& step, Index incoming, Index outgoing);
/// Seam of two front edges of very different length: the longer is split first. Thesis 2.2.4, figure 2.1.
bool transition_seam(Step& step, Index incoming, Index outgoing);
/// Splits a front edge that is too long, and the quad behind it; the part of the quad at `k`, one of the edge's ends,
/// becomes a quad with half of the edge. Returns the new front edge that is to be the next base, or kNone.
/// Thesis 2.2.4, figure 3.3.
Index transition_split(Step& step, Index longer, Index k);

// --- small_loops.cpp --------------------------------------------------------------------------------------

/// A front loop that may be filled at once: four or six edges.
struct SmallLoop {
  std::array<Index, 6> edges{};
  std::size_t size = 0;  ///< 0: none
};
/// The loop of a base edge if it is small and passes no node twice.
SmallLoop find_small_loop(const Step& step, const Base& base);
/// Fills it if it has few triangles inside. Thesis 2.2.3.
bool close_small_loop(Step& step, const SmallLoop& small);

// --- local_smoothing.cpp ------------------------------------------------------------------------------------

/// Smooths the nodes of a face, and the neighbours of those that move, and notes in `step.moved` which of the front
/// moved. Thesis 3.5.5.
void smooth_around(Step& step, Index face);

/// New node at p on the edge of h, whose faces are triangles: both are split. Returns the node.
Index split_triangles(Step& step, Index h, const Vec2& p);

}  // namespace qmorph::front
