// SPDX-License-Identifier: GPL-2.0-or-later
#include "stretch/straighten.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "smoothing/grid.hpp"
#include "topology/edits.hpp"

namespace qmorph::stretch {
namespace {

using kernel::Mesh;

constexpr int kPasses = 12;
/// A node that moves by less, in lengths of the metric, rests until a neighbour moves.
constexpr double kRest = 0.01;
/// Quads below the first sine, by the metric, are raised; none falls below the second, or below what it was.
constexpr double kPoor = 0.4, kGood = 0.7;
/// A grid is not made even where shapes by the metric get worse by more than this factor.
constexpr double kMostForGrid = 1.4;
/// How much rectangles count where sides run along the axes; the rest is the shape by the metric.
constexpr double kRectangles = 0.8;

/// A symmetric matrix as a measure of squared lengths.
struct Form {
  double xx = 0, xy = 0, yy = 0;

  double operator()(const Vec2& v) const { return xx * v.x() * v.x() + 2 * xy * v.x() * v.y() + yy * v.y() * v.y(); }
  Vec2 times(const Vec2& v) const { return {xx * v.x() + xy * v.y(), xy * v.x() + yy * v.y()}; }
  /// A share of a multiple of the unit matrix, the rest of this one.
  Form mixed(double share, double multiple) const {
    return {(1 - share) * xx + share * multiple, (1 - share) * xy, (1 - share) * yy + share * multiple};
  }
};

/// What shapes an element is to have.
struct Target {
  Form metric;         ///< with determinant 1
  double upright = 0;  ///< how much rectangles count
  double ratio = 1;    ///< of their sides: of the one that starts at the face's half-edge, over the next
};

/// Sum over corners of mu^2, where mu = (P(e1) + Q(e2)) / (2 e1 x e2) for the edges of a corner: 1 if it is what it is
/// to be.
struct Energy {
  bool finite = true;
  double value = 0;
  Vec2 gradient = Vec2::Zero();
  Form hessian{};  ///< without what may be negative in it

  /// \param slope of the area
  /// \param pull half the gradient of the squares
  /// \param stiff half their second derivative
  void add(double squares, double area, const Vec2& slope, const Vec2& pull, const Form& stiff) {
    if (!(area > 0)) {
      finite = false;
      return;
    }
    const double mu = squares / (2 * area);
    const Vec2 rise = (pull - mu * slope) / area;
    value += mu * mu;
    gradient += 2 * mu * rise;
    hessian.xx += 2 * (rise.x() * rise.x() + mu * stiff.xx / area);
    hessian.xy += 2 * (rise.x() * rise.y() + mu * stiff.xy / area);
    hessian.yy += 2 * (rise.y() * rise.y() + mu * stiff.yy / area);
  }
  Vec2 step() const {
    const double determinant = hessian.xx * hessian.yy - hessian.xy * hessian.xy;
    return Vec2(hessian.xy * gradient.y() - hessian.yy * gradient.x(),
                hessian.xy * gradient.x() - hessian.xx * gradient.y()) /
           determinant;
  }
};

class Straightening {
 public:
  Straightening(Mesh& mesh, const std::vector<LogMetric>& metrics)
      : mesh_(mesh), metrics_(metrics), targets_(mesh.face_slots()), active_(mesh.vertex_slots(), 1) {
    for (Index f = 0; f < mesh.face_slots(); ++f)
      if (mesh.is_live_face(f)) targets_[f] = target_of(f);
  }

  void run() {
    raise_poor();
    relax_all();
    snap_to_grid();
  }

 private:
  void relax_all() {
    for (int pass = 0; pass < kPasses; ++pass) {
      bool any = false;
      for (Index v = 0; v < mesh_.vertex_slots(); ++v)
        if (active_[v] && mesh_.is_live_vertex(v) && mesh_.is_free(v)) any |= relax(v);
      if (!any) return;
    }
  }

  void snap_to_grid() {
    std::vector<Vec2> points(mesh_.vertex_slots());
    for (Index v = 0; v < points.size(); ++v) points[v] = mesh_.point(v);
    const double before = mean_shape();
    if (!smoothing::snap_to_grid(mesh_) || mean_shape() <= kMostForGrid * before) return;
    for (Index v = 0; v < points.size(); ++v) mesh_.set_point(v, points[v]);
  }

  /// Of all corners, mu by the metric.
  double mean_shape() const {
    double sum = 0, corners = 0;
    for (Index f = 0; f < mesh_.face_slots(); ++f) {
      if (!mesh_.is_live_face(f)) continue;
      const Form& metric = targets_[f].metric;
      for (Index h : mesh_.sides_of(f)) {
        const Vec2 ahead = mesh_.vector(h), behind = -mesh_.vector(mesh_.prev(h));
        sum += (metric(ahead) + metric(behind)) / (2 * cross(ahead, behind));
        ++corners;
      }
    }
    return sum / corners;
  }

  LogMetric metric_at(Index f) const {
    LogMetric sum;
    mesh_.for_nodes_of(f, [&](Index v) { sum += metrics_[v]; });
    return sum * (1 / double(mesh_.degree(f)));
  }

  Target target_of(Index f) const {
    LogMetric metric = metric_at(f);
    metric.scale = 0;
    const Eigen::Matrix2d map = metric.unstretch(), square = map * map;
    Target target{{square(0, 0), square(0, 1), square(1, 1)}};
    if (mesh_.degree(f) == 3) return target;
    const Index h = mesh_.half_edge(f), opposite = mesh_.next(mesh_.next(h));
    const Vec2 along = mesh_.vector(h) - mesh_.vector(opposite),
               across = mesh_.vector(mesh_.next(h)) - mesh_.vector(mesh_.prev(h));
    // By the metric, the angle from its axis; that of the other side is a right angle off.
    const double axis = std::atan2(metric.turn.y(), metric.turn.x()) / 2;
    const auto angle = [&](const Vec2& v) {
      const Vec2 seen = map * v;
      return std::atan2(seen.y(), seen.x()) - axis;
    };
    const double one = angle(along), two = angle(across);
    const double even = (std::cos(4 * one) + std::cos(4 * two)) / 2;
    // The square of the sine, in the plane, of a corner between such sides that is right by the metric: where they are
    // so far off that nothing makes them upright, the metric alone counts.
    const double ratio = metric.ratio(), lean = (ratio - 1 / ratio) / 2;
    target.upright = kRectangles / (1 + lean * lean * (1 - even) / 2);
    // Lengths are largest along the axis, so that sides are short there.
    target.ratio = std::cos(2 * one) > 0 ? 1 / ratio : ratio;
    return target;
  }

  /// The forms that measure the side of h, and the one before or after it.
  std::array<Form, 2> forms(Index f, Index h) const {
    const Target& target = targets_[f];
    const Index first = mesh_.half_edge(f);
    const bool is_even = h == first || h == mesh_.next(mesh_.next(first));
    const double other = is_even ? 1 / target.ratio : target.ratio;  // the shorter a side is to be, the more it counts
    return {target.metric.mixed(target.upright, other), target.metric.mixed(target.upright, 1 / other)};
  }

  /// Of the elements around v, if that is at p.
  Energy energy(Index v, const Vec2& p) const {
    Energy energy;
    for (Index h : mesh_.around(v)) {
      const Index f = mesh_.face(h), ahead = mesh_.next(h), behind = mesh_.prev(h);
      const auto [here, beside] = forms(f, h);
      const bool is_quad = mesh_.degree(f) == 4;
      const Vec2 &q = mesh_.point(mesh_.target(h)), &r = mesh_.point(mesh_.origin(behind));
      const Vec2 &after_q = mesh_.point(mesh_.target(ahead)),
                 &before_r = is_quad ? mesh_.point(mesh_.origin(mesh_.prev(behind))) : q;
      const Vec2 pq = q - p, pr = r - p, qa = after_q - q, rb = before_r - r;
      energy.add(here(pq) + beside(pr), cross(pq, pr), left_of(r - q), -here.times(pq) - beside.times(pr),
                 sum(here, beside));
      energy.add(here(pq) + beside(qa), cross(qa, -pq), left_of(qa), -here.times(pq), here);
      energy.add(beside(pr) + here(rb), cross(-pr, rb), -left_of(rb), -beside.times(pr), beside);
    }
    return energy;
  }

  static Form sum(const Form& a, const Form& b) { return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy}; }

  /// Smallest sine of a face's corners by the metric.
  double sine(Index f) const {
    const Form& metric = targets_[f].metric;
    double least = 1;
    for (Index h : mesh_.sides_of(f)) {
      const Vec2 ahead = mesh_.vector(h), behind = -mesh_.vector(mesh_.prev(h));
      const double lengths2 = metric(ahead) * metric(behind);
      least = std::min(least, lengths2 > 0 ? cross(ahead, behind) / std::sqrt(lengths2) : 0);
    }
    return least;
  }

  double sine_around(Index v) const {
    double least = 1;
    for (Index h : mesh_.around(v)) least = std::min(least, sine(mesh_.face(h)));
    return least;
  }

  bool relax(Index v) {
    constexpr int kHalvings = 3;
    active_[v] = 0;
    const Vec2 before = mesh_.point(v);
    const Energy here = energy(v, before);
    if (!here.finite) return false;
    const Vec2 way = here.step();
    const double moves = metrics_[v].length(way);
    if (!(moves > kRest)) return false;
    const double least = std::min(kGood, sine_around(v));
    double share = 1;
    for (int i = 0; i < kHalvings; ++i, share /= 2) {
      const Energy there = energy(v, before + share * way);
      if (!there.finite || !(there.value < here.value)) continue;
      mesh_.set_point(v, before + share * way);
      if (sine_around(v) >= least) {
        wake_around(v);
        return true;
      }
      mesh_.set_point(v, before);
    }
    return false;
  }

  void wake_around(Index v) {
    for (Index h : mesh_.around(v)) mesh_.for_nodes_of(mesh_.face(h), [&](Index u) { active_[u] = 1; });
  }

  void raise_poor() {
    constexpr int kRounds = 10;
    for (int round = 0; round < kRounds; ++round) {
      bool any = false;
      for (Index f = 0; f < mesh_.face_slots(); ++f) {
        if (!mesh_.is_live_face(f) || sine(f) >= kPoor) continue;
        for (Index v : topology::nodes_of(mesh_, f))
          if (mesh_.is_free(v)) any |= raise(v);
      }
      if (!any) return;
    }
  }

  /// To where the smallest sine around is largest, by compass search.
  bool raise(Index v) {
    constexpr double kFirst = 0.3, kLast = 0.01;  // steps, in lengths of the metric
    const Eigen::Matrix2d from_metric = metrics_[v].unstretch().inverse();
    double best = sine_around(v), length = kFirst;
    bool moved = false;
    while (length > kLast) {
      const Vec2 at = mesh_.point(v);
      Vec2 to = at;
      for (int i = 0; i < 8; ++i) {
        const Vec2 p = at + from_metric * rotated(Vec2(length, 0), i * std::numbers::pi / 4);
        mesh_.set_point(v, p);
        if (const double there = sine_around(v); there > best) best = there, to = p;
      }
      mesh_.set_point(v, to);
      if (to == at)
        length /= 2;
      else
        moved = true;
    }
    return moved;
  }

  Mesh& mesh_;
  const std::vector<LogMetric>& metrics_;
  std::vector<Target> targets_;  ///< by face
  std::vector<char> active_;     ///< by node
};

}  // namespace

void straighten(Mesh& mesh, const std::vector<LogMetric>& metrics) { Straightening(mesh, metrics).run(); }

}  // namespace qmorph::stretch
