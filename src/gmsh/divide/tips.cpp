// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/divide/tips.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "gmsh/session/compat.hpp"
#include "kernel/sort_unique.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector3d;

/// Between the first segments, degrees: a sine of 0.29.
constexpr double kWanted = 17;
/// Of the size: longer ones are not worth it.
constexpr double kLongest = 3;
/// Of a curve, from one or from both of its ends: there is at least one segment besides.
constexpr double kMostOfCurve = 0.6, kMostOfBoth = 0.8;
/// A remainder longer than this share of a segment becomes one more, since Gmsh rounds up.
constexpr double kRoundedDown = 0.25;
/// By how much sizes fall off behind the first segment, per length.
constexpr double kSlope = 0.8;
/// Where the angle is wider, one segment more on a side leaves it wide enough.
constexpr double kAtRisk = 25;
/// Of the angle, if segments are half as long: sides that are not bent apart have nearly all of it.
constexpr double kBentApart = 0.8;

/// A curve as it leaves a tip.
class Side {
 public:
  Side(const DividedCurve& curve, bool from_back) : curve_(curve), from_back_(from_back) {}

  /// Where one is after `length`, along the chords of the finer nodes.
  Vector3d point_after(double length) const {
    for (std::size_t i = 0; i + 1 < curve_.points.size(); ++i) {
      const double step = (point(i + 1) - point(i)).norm();
      if (length <= step) return point(i) + (step > 0 ? length / step : 0) * (point(i + 1) - point(i));
      length -= step;
    }
    return point(curve_.points.size() - 1);
  }

  /// The length of the first segment, as the sizes have it.
  double size() const {
    const double finer = double(curve_.finer) / double(curve_.segments);
    double length = 0;
    for (std::size_t i = 0; i < std::size_t(std::lround(finer)); ++i) length += (point(i + 1) - point(i)).norm();
    return length;
  }

 private:
  const Vector3d& point(std::size_t i) const { return curve_.points[from_back_ ? curve_.points.size() - 1 - i : i]; }
  const DividedCurve& curve_;
  bool from_back_;
};

/// Between chords of these lengths, in radians.
double angle_between(const Side& a, double length_a, const Side& b, double length_b) {
  const Vector3d tip = a.point_after(0), p = a.point_after(length_a) - tip, q = b.point_after(length_b) - tip;
  return std::atan2(p.cross(q).norm(), p.dot(q));
}

/// Whether the surface is between the two sides, not around them.
bool lies_between(int surface, const Side& a, const Side& b, double length) {
  const Vector3d middle = (a.point_after(length) + b.point_after(length)) / 2;
  std::vector<double> parameters;
  ::gmsh::model::getParametrization(2, surface, {middle.x(), middle.y(), middle.z()}, parameters);
  return parameters.size() == 2 && is_inside(surface, parameters);
}

/// Lengths of the first segments at both ends; 0: as they are.
struct FirstLengths {
  double front = 0, back = 0;
};

/// Finer nodes as far apart as these first segments ask for, and marks at their ends.
void mark(DividedCurve& curve, FirstLengths first) {
  if (const double both = first.front + first.back; both > kMostOfBoth * curve.length) {
    first.front *= kMostOfBoth * curve.length / both;
    first.back *= kMostOfBoth * curve.length / both;
  }
  std::vector<double> in_sizes{0};  // up to each of the finer nodes
  const double finer_in_size = double(curve.finer) / double(curve.segments);
  double along = 0;
  for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
    const double step = (curve.points[i + 1] - curve.points[i]).norm(), middle = along + step / 2;
    double size = finer_in_size * step;
    for (const auto& [length, from_end] : {std::pair(first.front, middle), {first.back, curve.length - middle}})
      size = from_end < length ? length : std::max(size, length - kSlope * (from_end - length));
    in_sizes.push_back(in_sizes.back() + step / size);
    along += step;
  }
  const double sizes = in_sizes.back();
  curve.segments = std::max(2, int(std::ceil(sizes - kRoundedDown)));
  curve.finer = std::max(curve.segments + 1, int(std::lround(finer_in_size * sizes)));
  std::vector<double> parameters{curve.parameters.front()};
  std::size_t i = 1;
  for (int k = 1; k < curve.finer; ++k) {
    const double at = sizes * k / curve.finer;
    while (in_sizes[i] < at) ++i;
    const double share = (at - in_sizes[i - 1]) / (in_sizes[i] - in_sizes[i - 1]);
    parameters.push_back(curve.parameter_at(double(i - 1) + share));
  }
  parameters.push_back(curve.parameters.back());
  curve.parameters = std::move(parameters);
  curve.points = points_at(curve, curve.parameters);
  if (first.front > 0) curve.tips.push_back(curve.finer / sizes);
  if (first.back > 0) curve.tips.push_back(curve.finer - curve.finer / sizes);
}

class TipMarker {
 public:
  TipMarker(CurveModel model, const std::vector<bool>& may_change)
      : model_(std::move(model)), may_change_(may_change), first_(model_.curves.size()) {
    for (const auto& [a, b] : model_.images) may_change_[a] = may_change_[b] = false;
    for (Index c = 0; c < model_.curves.size(); ++c)
      if (model_.curves[c].segments < 2 || model_.curves[c].is_spare) may_change_[c] = false;
  }

  CurveModel run() {
    for (const BoundedSurface& surface : model_.surfaces) look_at(surface);
    for (Index c = 0; c < model_.curves.size(); ++c)
      if (first_[c].front > 0 || first_[c].back > 0) mark(model_.curves[c], first_[c]);
    return std::move(model_);
  }

 private:
  /// A curve that ends in a point: as it leaves it.
  struct Leaving {
    Index curve;
    bool from_back;
  };

  void look_at(const BoundedSurface& surface) {
    std::vector<Index> boundary = surface.boundary;
    sort_unique(boundary);
    std::map<int, std::vector<Leaving>> at_point;
    for (Index c : boundary)
      for (int end : {0, 1})
        if (model_.curves[c].segments > 0) at_point[model_.curves[c].ends[end]].push_back({c, end == 1});
    for (const auto& [point, curves] : at_point)
      for (std::size_t i = 0; i < curves.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) look_at(surface.tag, curves[j], curves[i]);
  }

  void look_at(int surface, const Leaving& one, const Leaving& other) {
    const auto is_changeable = [&](const Leaving& c) { return bool(may_change_[c.curve]); };
    if (one.curve == other.curve || (!is_changeable(one) && !is_changeable(other))) return;
    const Side a(model_.curves[one.curve], one.from_back), b(model_.curves[other.curve], other.from_back);
    const std::optional<double> length =
        better_length({a, a.size(), is_changeable(one)}, {b, b.size(), is_changeable(other)}, longest(one, other));
    if (!length || !lies_between(surface, a, b, *length)) return;
    for (const Leaving& c : {one, other})
      if (is_changeable(c)) set(c.curve, c.from_back, *length);
  }

  double longest(const Leaving& one, const Leaving& other) const {
    double most = std::numeric_limits<double>::infinity();
    for (const Leaving& c : {one, other})
      if (may_change_[c.curve]) most = std::min(most, kMostOfCurve * model_.curves[c.curve].length);
    return most;
  }

  struct FirstSegment {
    const Side& side;
    double length;
    bool may_change;
  };

  /// The shortest one that is good enough, or the best.
  static std::optional<double> better_length(const FirstSegment& a, const FirstSegment& b, double longest) {
    constexpr int kSteps = 16;
    constexpr double kDegree = std::numbers::pi / 180;
    const double angle = angle_between(a.side, a.length, b.side, b.length);
    const double half = angle_between(a.side, a.length / 2, b.side, b.length / 2);
    if (angle > kAtRisk * kDegree || half > kBentApart * angle) return std::nullopt;
    const double from = std::min({a.length, b.length, longest}), to = std::min(longest, kLongest * from);
    double best_angle = 0, best = from;
    for (int k = 0; k <= kSteps && best_angle < kWanted * kDegree; ++k) {
      const double length = from + (to - from) * k / kSteps;
      const double angle_there = angle_between(a.side, a.may_change ? length : a.length,  //
                                               b.side, b.may_change ? length : b.length);
      if (angle_there <= best_angle) continue;
      best_angle = angle_there;
      best = length;
    }
    return best_angle < angle && angle < kWanted * kDegree ? std::nullopt : std::optional(best);
  }

  void set(Index curve, bool from_back, double length) {
    double& first = from_back ? first_[curve].back : first_[curve].front;
    first = std::max(first, length);
  }

  CurveModel model_;
  std::vector<bool> may_change_;
  std::vector<FirstLengths> first_;  ///< by curve
};

}  // namespace

CurveModel mark_tips(CurveModel model, const std::vector<bool>& may_change) {
  return TipMarker(std::move(model), may_change).run();
}

}  // namespace qmorph::adapter
