// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/settle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "space/flat_shapes.hpp"

namespace qmorph::space {
namespace {

using Eigen::Vector3d;

/// Up to this distance of a centre the pull on it fades (edges).
constexpr double kNear = 0.01;
/// Distances of the centres around a node that are less in all (edges): the surface is flat there.
constexpr double kFlat = 1e-3;
/// Sines of corners that one edge's distance of a centre is worth.
constexpr double kShapeCost = 0.184;
/// With less to gain than this for each face around a node, on average, what can be gained is not worth the time.
constexpr double kSettled = 0.01;
/// How far off is what slopes say about the distances around a node, in all (edges).
constexpr double kDoubt = 2e-4;
/// And the tangent plane about the shapes there, besides.
constexpr double kDoubtOfShapes = 4e-4;
constexpr double kRounding = 1e-9;  ///< of such sums

class Settling {
 public:
  Settling(MeshOnSurface& mesh, const SmoothingOptions& options)
      : mesh_(mesh), options_(options), is_active_(mesh.nodes(), 1), way_(mesh.nodes(), Vector3d::Zero()) {
    for (Index v = 0; v < mesh.nodes(); ++v) start_.push_back(mesh.place(v));
    for (Index f = 0; f < mesh.faces(); ++f) seats_.push_back(seat_of(f, mesh.mesh().near[f]));
  }

  void run() {
    constexpr int kPasses = 10, kFinePasses = 3;
    for (int pass = 0; pass < kPasses; ++pass)
      for (Index v = 0; v < mesh_.nodes(); ++v)
        if (is_active_[v] && mesh_.is_to_be_smoothed(v)) settle(v);
    double step = 0.1;  // edges
    for (int pass = 0; pass < kFinePasses; ++pass, step /= 2)
      for (Index v = 0; v < mesh_.nodes(); ++v)
        if (mesh_.is_to_be_smoothed(v)) look_around(v, step);
  }

 private:
  /// How a face sits on the surface.
  struct Seat {
    double distance = 0;                ///< of a quad's centre, in edges
    double edge = 0;                    ///< length of a usual one; 0 if there is no distance
    Vector3d slope = Vector3d::Zero();  ///< how fast it grows when the centre moves
    double sine = 1;                    ///< the smallest one
    Index under = kNone;                ///< triangle under the centre
    double cost() const { return distance - kShapeCost * sine; }
  };

  Seat seat_of(Index f, Index hint) const { return seat_of(f, mesh_.sure_sine(f), hint); }
  Seat seat_of(Index f, double sine, Index hint) const {
    Seat seat;
    seat.sine = sine;
    if (chart::degree(mesh_.mesh().faces[f]) != 4) return seat;
    Vector3d centre = Vector3d::Zero();
    for (Index side = 4 * f; side < 4 * f + 4; ++side) centre += 0.25 * mesh_.point(mesh_.node(side));
    const Foot foot = mesh_.surface().walk(centre, hint);
    seat.under = foot.triangle;
    const double diagonal2 = (mesh_.point(mesh_.node(4 * f)) - mesh_.point(mesh_.node(4 * f + 2))).squaredNorm();
    const double edge = std::sqrt(0.5 * diagonal2), distance = std::sqrt(foot.distance2);
    if (!(edge > 0)) return seat;
    seat.distance = distance / edge;
    seat.edge = edge;
    seat.slope = (centre - foot.point) / std::max(distance, kNear * edge);
    return seat;
  }

  /// What the faces around a node say.
  struct Around {
    Vector3d slope = Vector3d::Zero();
    Vector3d ways = Vector3d::Zero();  ///< mean of those of the neighbours
    double cost = 0, distance = 0, sines = 0, faces = 0;
    double least;     ///< sine of the worst face, or what is good enough
    double edge = 0;  ///< mean length
    Index side = kNone;

    bool is_left_alone() const {
      constexpr double kPoor = 0.3;  // left to those who look closer
      return side == kNone || least < kPoor || distance <= kFlat || cost + kShapeCost * faces <= kSettled * faces;
    }
  };

  Around around(Index v) const {
    Around sum;
    sum.least = options_.good_quality;
    mesh_.for_sides_around(v, [&](Index side) {
      const Index other = mesh_.node(mesh_.next(side));
      const Seat& seat = seats_[side / 4];
      sum.slope += seat.slope;
      sum.cost += seat.cost();
      sum.distance += seat.distance;
      sum.sines += seat.sine;
      sum.least = std::min(sum.least, seat.sine);
      sum.ways += way_[other];
      sum.edge += (mesh_.point(other) - mesh_.point(v)).norm();
      sum.side = side;
      ++sum.faces;
    });
    if (sum.faces > 0) sum.edge /= sum.faces, sum.ways /= sum.faces;
    return sum;
  }

  /// Of a node's tangent plane; the first along an edge.
  struct Axes {
    Vector3d along, across;
  };
  Axes axes_at(Index v, Index side) const {
    const Vector3d& up = mesh_.surface().normal(mesh_.mesh().on[v]);
    const Vector3d edge = mesh_.point(mesh_.node(mesh_.next(side))) - mesh_.point(v);
    const Vector3d along = (edge - edge.dot(up) * up).normalized();
    return {along, up.cross(along)};
  }

  /// Whether slopes and the tangent plane leave a move any chance. flat_ has looked around v.
  bool is_promising(Index v, const Axes& axes, const Vector3d& way, const Around& here) const {
    double distances = 0;
    mesh_.for_sides_around(v, [&](Index side) { distances += expected_distance(seats_[side / 4], way); });
    const double gain = flat_.sines({way.dot(axes.along), way.dot(axes.across)}) - flat_sines_;
    return !(distances - kShapeCost * (here.sines + gain) >= here.cost + kDoubt + kDoubtOfShapes);
  }

  void look_at_shapes(Index v, const Axes& axes) {
    flat_.look_around(mesh_, v, axes.along, axes.across);
    flat_sines_ = flat_.sines(Vec2::Zero());
  }

  /// If a corner moves.
  static double expected_distance(const Seat& seat, const Vector3d& way) {
    return seat.edge > 0 ? std::max(0.0, seat.distance + 0.25 * seat.slope.dot(way) / seat.edge) : 0;
  }

  /// Sends a node downhill, half as far as its neighbours have come besides: where all go the same way no shape
  /// suffers.
  void settle(Index v) {
    constexpr double kGain = 0.5, kMost = 0.5, kLeastWay = 0.02;  // edges
    is_active_[v] = 0;
    const Around here = around(v);
    if (here.is_left_alone()) return;
    Vector3d way = 0.5 * (way_[v] + here.ways) - kGain * here.edge * here.slope;
    const Vector3d& up = mesh_.surface().normal(mesh_.mesh().on[v]);
    way -= way.dot(up) * up;
    const double length = way.norm(), most = kMost * here.edge;
    if (length > most) way *= most / length;
    try_ways(v, way, kLeastWay * here.edge, here);
  }

  /// Takes the first of four steps, along an edge and across, that is for the better: which way distances and shapes
  /// together get better no slope says.
  void look_around(Index v, double step) {
    const Around here = around(v);
    if (here.is_left_alone()) return;
    const MeshOnSurface::Place before = mesh_.place(v);
    const Axes axes = axes_at(v, here.side);
    const double length = step * here.edge;
    look_at_shapes(v, axes);
    for (const Vector3d& way : {Vector3d(length * axes.along), Vector3d(length * axes.across),
                                Vector3d(-length * axes.along), Vector3d(-length * axes.across)}) {
      if (!is_promising(v, axes, way, here)) continue;
      mesh_.move(v, before);
      mesh_.move(v, mesh_.foot(v, before.point + way));
      if (!is_better(v, before.point, here)) continue;
      auto seat = tried_.begin();
      mesh_.for_sides_around(v, [&](Index side) { seats_[side / 4] = *seat++; });
      return;
    }
    mesh_.move(v, before);
  }

  /// All of the way, or less of it. Steps that are shorter than `least_way` wake nobody.
  void try_ways(Index v, const Vector3d& way, double least_way, const Around& here) {
    const MeshOnSurface::Place before = mesh_.place(v);
    const Axes axes = axes_at(v, here.side);
    look_at_shapes(v, axes);
    for (const double share : {1.0, 0.5, 0.25}) {
      const Vector3d tried = way_[v] + share * (way - way_[v]);
      if (!is_promising(v, axes, start_[v].point + tried - before.point, here)) continue;
      mesh_.move(v, start_[v]);
      mesh_.move(v, mesh_.foot(v, start_[v].point + tried));
      if (!is_better(v, before.point, here)) continue;
      const bool is_far = (tried - way_[v]).norm() > least_way;
      way_[v] = tried;
      auto seat = tried_.begin();
      mesh_.for_sides_around(v, [&](Index first) {
        seats_[first / 4] = *seat++;
        if (is_far)
          for (Index side = mesh_.next(first); side != first; side = mesh_.next(side)) is_active_[mesh_.node(side)] = 1;
      });
      is_active_[v] = is_far;
      return;
    }
    mesh_.move(v, before);
  }

  /// Whether all is better with node v, which was at `from`, at its place; then tried_ has the seats of the faces.
  bool is_better(Index v, const Vector3d& from, const Around& here) {
    tried_.clear();
    double after = 0, expected = 0;
    bool good = true;
    mesh_.for_sides_around(v, [&](Index side) {  // shapes and slopes first, which take less time
      if (!good) return;
      const Seat& seat = seats_[side / 4];
      const double sine = mesh_.sure_sine(side / 4);
      good = sine >= here.least;
      expected += expected_distance(seat, mesh_.point(v) - from) - kShapeCost * sine;
      tried_.emplace_back().sine = sine;
    });
    if (!good || expected >= here.cost + kDoubt) return false;
    auto seat = tried_.begin();
    mesh_.for_sides_around(v, [&](Index side) {
      if (!good) return;
      *seat = seat_of(side / 4, seat->sine, seats_[side / 4].under);
      after += seat++->cost();
      // Others lower the cost by their shapes at most.
      good = after - kShapeCost * double(tried_.end() - seat) < here.cost + kRounding;
    });
    return good && after < here.cost;
  }

  MeshOnSurface& mesh_;
  const SmoothingOptions& options_;
  std::vector<Seat> seats_;  ///< by face
  FlatShapes flat_;
  double flat_sines_ = 0;        ///< where the node is now
  std::vector<Seat> tried_;      ///< of the faces around a node, if it stays
  std::vector<char> is_active_;  ///< by node: something around has moved since it was tried
  std::vector<MeshOnSurface::Place> start_;
  std::vector<Vector3d> way_;  ///< by node: from the start
};

}  // namespace

void settle(MeshOnSurface& mesh, const SmoothingOptions& options) { Settling(mesh, options).run(); }

}  // namespace qmorph::space
