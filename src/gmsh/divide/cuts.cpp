// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/divide/cuts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/sort_unique.hpp"
#include "space/closest_point.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;

/// A surface is thin where it is thinner than so many sizes.
constexpr double kThin = 0.3;
/// No piece is shorter than so many sizes, unless what faces it is.
constexpr double kShortest = 0.5;
/// What faces each other may differ in length by this factor.
constexpr double kLonger = 1.25;

/// Where on a curve the nearest point to `p` is, in segments of its finer nodes, and how far away.
std::pair<double, double> nearest_on(const DividedCurve& curve, const Vector3d& p) {
  std::pair<double, double> best(0, (curve.points[0] - p).norm());
  for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
    const Vector3d &a = curve.points[i], &b = curve.points[i + 1];
    const double t = space::closest_on_segment(p, a, b);
    const double distance = (a + t * (b - a) - p).norm();
    if (distance < best.second) best = {double(i) + t, distance};
  }
  return best;
}

class Cutter {
 public:
  Cutter(const CurveModel& model, const std::vector<bool>& may_cut)
      : model_(model), may_cut_(may_cut), cuts_(model.curves.size()) {
    for (const auto& [a, b] : model_.images) may_cut_[a] = may_cut_[b] = false;
    for (Index c = 0; c < model_.curves.size(); ++c) {
      const DividedCurve& curve = model_.curves[c];
      Box box;
      for (const Vector3d& p : curve.points) box.extend(p);
      boxes_.push_back(box);
      if (curve.segments == 0) may_cut_[c] = false;
    }
  }

  CurveModel run() {
    for (Index c = 0; c < model_.curves.size(); ++c)
      for (double tip : model_.curves[c].tips) add(c, tip);
    for (const BoundedSurface& surface : model_.surfaces) look_at(surface);
    for (std::vector<double>& cuts : cuts_) sort_unique(cuts);
    return write();
  }

 private:
  double finer_in_size(const DividedCurve& curve) const { return double(curve.finer) / double(curve.segments); }

  void look_at(const BoundedSurface& surface) {
    std::vector<std::pair<int, Vector3d>> corners;
    for (Index c : surface.boundary) {
      const DividedCurve& curve = model_.curves[c];
      if (curve.segments == 0) continue;
      corners.emplace_back(curve.ends[0], curve.points.front());
      corners.emplace_back(curve.ends[1], curve.points.back());
    }
    const auto is_less = [](const auto& a, const auto& b) { return a.first < b.first; };
    const auto is_same = [](const auto& a, const auto& b) { return a.first == b.first; };
    std::sort(corners.begin(), corners.end(), is_less);
    corners.erase(std::unique(corners.begin(), corners.end(), is_same), corners.end());
    for (Index c : surface.boundary)
      for (Index d : surface.boundary) look_for_short_side(c, d);
    for (Index c : surface.boundary)
      if (may_cut_[c])
        for (const auto& [point, place] : corners) look_at(c, point, place);
    for (std::size_t i = 0; i < surface.boundary.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) look_for_neck(surface.boundary[i], surface.boundary[j]);
  }

  /// Where a curve shorter than the size lies close to a longer one, as the end of a rib does to the edge of a plate,
  /// the longer one has a piece as short.
  void look_for_short_side(Index c, Index d) {
    const DividedCurve &curve = model_.curves[c], &side = model_.curves[d];
    if (c == d || !may_cut_[c] || side.segments == 0 || side.length > curve.size()) return;
    const double thin = kThin * curve.size();
    if (boxes_[c].exteriorDistance(boxes_[d]) > thin) return;
    for (int end : side.ends)
      if (end == curve.ends[0] || end == curve.ends[1]) return;
    auto [from, gap] = nearest_on(curve, side.points.front());
    auto [to, other_gap] = nearest_on(curve, side.points.back());
    if (from > to) std::swap(from, to);
    const double length = (to - from) * curve.length / curve.finer;
    if (std::max(gap, other_gap) > thin || length > kLonger * side.length || side.length > kLonger * length) return;
    if (may_add(c, from) && may_add(c, to)) cuts_[c].insert(cuts_[c].end(), {from, to});
  }

  /// Where two curves come close to each other and part again, both get a node there, so that the next ones face each
  /// other, too.
  void look_for_neck(Index c, Index d) {
    constexpr std::size_t kMostPoints = 2000;  // each is compared with each
    constexpr int kAway = 2;                   // in sizes: there the curves have parted
    const DividedCurve &one = model_.curves[c], &other = model_.curves[d];
    if (c == d || !may_cut_[c] || !may_cut_[d] || one.points.size() + other.points.size() > kMostPoints) return;
    for (int end : one.ends)
      if (end == other.ends[0] || end == other.ends[1]) return;
    const double size = std::min(one.size(), other.size()), thin = kThin * size;
    if (boxes_[c].exteriorDistance(boxes_[d]) > thin) return;
    std::vector<double> gaps;
    for (const Vector3d& p : one.points) gaps.push_back(nearest_on(other, p).second);
    const auto neck = std::size_t(std::min_element(gaps.begin(), gaps.end()) - gaps.begin());
    const auto away = std::size_t(std::lround(kAway * finer_in_size(one)));
    if (gaps[neck] > thin || neck < away || neck + away >= gaps.size()) return;
    if (std::min(gaps[neck - away], gaps[neck + away]) < gaps[neck] + thin) return;  // a band
    add(c, double(neck));
    add(d, nearest_on(other, one.points[neck]).first);
  }

  /// Whether no piece becomes too short.
  bool may_add(Index c, double at) const {
    const DividedCurve& curve = model_.curves[c];
    const double shortest = kShortest * finer_in_size(curve);
    const auto is_near = [&](double cut) { return std::abs(cut - at) < shortest; };
    return at >= shortest && at <= curve.finer - shortest && std::none_of(cuts_[c].begin(), cuts_[c].end(), is_near);
  }

  void add(Index c, double at) {
    if (may_add(c, at)) cuts_[c].push_back(at);
  }

  void look_at(Index c, int point, const Vector3d& place) {
    const DividedCurve& curve = model_.curves[c];
    const double thin = kThin * curve.size();
    if (point == curve.ends[0] || point == curve.ends[1] || boxes_[c].exteriorDistance(place) > thin) return;
    const auto [at, distance] = nearest_on(curve, place);
    if (distance <= thin) add(c, at);
  }

  CurveModel write() {
    CurveModel result;
    std::vector<bool> may_change;
    std::vector<std::vector<Index>> pieces(model_.curves.size());
    int point = 0;
    for (Index c = 0; c < model_.curves.size(); ++c) {
      std::vector<double> ends{0};
      ends.insert(ends.end(), cuts_[c].begin(), cuts_[c].end());
      ends.push_back(model_.curves[c].finer);
      for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
        pieces[c].push_back(Index(result.curves.size()));
        may_change.push_back(may_cut_[c]);
        if (ends.size() == 2) {
          result.curves.push_back(model_.curves[c]);
          continue;
        }
        DividedCurve piece = piece_of(model_.curves[c], ends[k], ends[k + 1]);
        if (k > 0) piece.ends[0] = point;
        if (k + 2 < ends.size()) piece.ends[1] = --point;
        result.curves.push_back(std::move(piece));
      }
    }
    const auto all_pieces = [&](const std::vector<Index>& curves) {
      std::vector<Index> all;
      for (Index c : curves) all.insert(all.end(), pieces[c].begin(), pieces[c].end());
      return all;
    };
    for (const BoundedSurface& surface : model_.surfaces)
      result.surfaces.push_back({surface.tag, all_pieces(surface.boundary), all_pieces(surface.embedded)});
    for (const auto& [a, b] : model_.images) result.images.emplace_back(pieces[a][0], pieces[b][0]);
    for (Index s = 0; s < model_.surfaces.size(); ++s)
      for (Index c : model_.surfaces[s].boundary)
        for (Index piece : pieces[c])
          if (pieces[c].size() > 1) match(result, result.surfaces[s], piece, model_.curves[c].size(), may_change);
    return result;
  }

  /// The piece and the curve that faces it from end to end want as many segments, whatever their sizes are.
  void match(CurveModel& result, const BoundedSurface& surface, Index piece, double size,
             const std::vector<bool>& may_change) const {
    constexpr int kFew = 2;  // segments of a curve that is as short as curves may be
    const DividedCurve& one = result.curves[piece];
    for (Index c : surface.boundary) {
      const DividedCurve& other = result.curves[c];
      if (c == piece || other.segments == 0 || !(may_change[c] || other.segments <= kFew)) continue;
      if (std::max(one.length, other.length) > kLonger * std::min(one.length, other.length)) continue;
      const double thin = kThin * size;
      const auto is_near = [&](const Vector3d& a, const Vector3d& b) { return (a - b).norm() <= thin; };
      const Vector3d &p = one.points.front(), &q = one.points.back(), &u = other.points.front(),
                     &v = other.points.back();
      if ((is_near(p, u) && is_near(q, v)) || (is_near(p, v) && is_near(q, u))) result.images.emplace_back(c, piece);
    }
  }

  DividedCurve piece_of(const DividedCurve& curve, double from, double to) const {
    const double finer = to - from;
    DividedCurve piece;
    piece.tag = curve.tag;
    piece.segments = std::max(1, int(std::lround(finer / finer_in_size(curve))));
    piece.finer = std::max(int(std::lround(finer)), piece.segments + 1);
    for (int i = 0; i <= piece.finer; ++i)
      piece.parameters.push_back(curve.parameter_at(from + finer * i / piece.finer));
    piece.points = points_at(curve, piece.parameters);
    for (std::size_t i = 1; i < piece.points.size(); ++i)
      piece.length += (piece.points[i] - piece.points[i - 1]).norm();
    piece.ends = curve.ends;
    return piece;
  }

  const CurveModel& model_;
  std::vector<bool> may_cut_;
  std::vector<std::vector<double>> cuts_;  ///< by curve, in segments of the finer nodes
  std::vector<Box> boxes_;
};

}  // namespace

CurveModel cut_at_narrow_places(const CurveModel& model, const std::vector<bool>& may_cut) {
  return Cutter(model, may_cut).run();
}

}  // namespace qmorph::adapter
