// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/divide/bands.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "gmsh/divide/loops.hpp"
#include "kernel/sort_unique.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector3d;
using parity::Band;

/// In sizes: wider ones have room for rows that end between their sides.
constexpr double kThickest = 3.2;
/// The same curves, seen from across, may differ in length by this factor.
constexpr double kLongest = 1.5;
/// Opposite sides of a surface with four corners, if it is no strip.
constexpr double kNearlySame = 1.15;
constexpr std::size_t kSamples = 24;
constexpr std::size_t kMostCurvesOfStrip = 64;

class BandFinder {
 public:
  explicit BandFinder(const CurveModel& model) : model_(model) {}
  void look_at(Index surface);
  std::vector<Band> take() { return std::move(bands_); }

 private:
  const DividedCurve& curve(Index c) const { return model_.curves[c]; }
  double length(const Chain& chain) const;
  int segments(const Chain& chain) const;
  double size(const Chain& a, const Chain& b) const;
  std::vector<Vector3d> points(const Chain& chain) const;
  Vector3d start(const DirectedCurve& c) const;
  bool is_near(const Chain& from, const Chain& to, double most) const;
  bool face(const Chain& a, const Chain& b) const;

  bool add_crescent(const Chain& loop);
  void add_pinched_ring(const std::vector<Index>& boundary);
  bool add_strip(const Chain& loop);
  void add_four_sides(const Chain& loop);
  bool add_ring(const Chain& a, const Chain& b);
  void add_pairs(const std::vector<Index>& boundary);
  bool face_from_end_to_end(Index a, Index b) const;
  std::vector<Band> in_pieces(const Chain& a, const Chain& b) const;
  void add(const Chain& a, const Chain& b) { bands_.push_back(band(a, b)); }
  Band band(const Chain& a, const Chain& b) const;
  bool is_side_of_frame(const Band& band) const;

  const CurveModel& model_;
  Index surface_ = kNone;
  std::vector<Band> bands_;
};

Chain reversed(Chain chain) {
  std::reverse(chain.begin(), chain.end());
  for (DirectedCurve& c : chain) c.turned = !c.turned;
  return chain;
}

/// From position `from` up to the one before `to`, around the end if need be.
Chain part(const Chain& loop, std::size_t from, std::size_t to) {
  Chain chain;
  for (std::size_t i = from % loop.size(); i != to % loop.size(); i = (i + 1) % loop.size()) chain.push_back(loop[i]);
  return chain;
}

double BandFinder::length(const Chain& chain) const {
  double sum = 0;
  for (const DirectedCurve& c : chain) sum += curve(c.curve).length;
  return sum;
}

int BandFinder::segments(const Chain& chain) const {
  int sum = 0;
  for (const DirectedCurve& c : chain) sum += curve(c.curve).segments;
  return sum;
}

double BandFinder::size(const Chain& a, const Chain& b) const {
  return (length(a) + length(b)) / std::max(1, segments(a) + segments(b));
}

std::vector<Vector3d> BandFinder::points(const Chain& chain) const {
  std::vector<Vector3d> all;
  for (const DirectedCurve& c : chain) {
    const std::vector<Vector3d>& own = curve(c.curve).points;
    if (c.turned)
      all.insert(all.end(), own.rbegin(), own.rend());
    else
      all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

Vector3d BandFinder::start(const DirectedCurve& c) const {
  return c.turned ? curve(c.curve).points.back() : curve(c.curve).points.front();
}

double distance_to(const std::vector<Vector3d>& points, const Vector3d& p) {
  double least = (points.front() - p).squaredNorm();
  for (const Vector3d& q : points) least = std::min(least, (q - p).squaredNorm());
  return std::sqrt(least);
}

/// Nowhere farther from the other than `most`.
bool BandFinder::is_near(const Chain& from, const Chain& to, double most) const {
  const std::vector<Vector3d> there = points(to), here = points(from);
  const std::size_t step = std::max<std::size_t>(1, here.size() / kSamples);
  // From the middle on, where a surface that is no band is thickest.
  for (std::size_t i = here.size() / 2; i < here.size(); i += step)
    if (distance_to(there, here[i]) > most) return false;
  for (std::size_t i = here.size() / 2; i >= step; i -= step)
    if (distance_to(there, here[i - step]) > most) return false;
  return true;
}

bool BandFinder::face(const Chain& a, const Chain& b) const {
  const double la = length(a), lb = length(b);
  if (std::max(la, lb) > kLongest * std::min(la, lb)) return false;
  const double most = kThickest * size(a, b);
  return is_near(a, b, most) && is_near(b, a, most);
}

Band BandFinder::band(const Chain& a, const Chain& b) const {
  Band band{surface_, {}, {}};
  for (const DirectedCurve& c : a) band.one.push_back(c.curve);
  for (const DirectedCurve& c : b) band.other.push_back(c.curve);
  return band;
}

/// Two sides that run the same way, cut where a point of the one is across from one of the other.
std::vector<Band> BandFinder::in_pieces(const Chain& a, const Chain& b) const {
  constexpr double kAskew = 0.35;  // sizes that points across from each other may be off
  const double slack = kAskew * size(a, b);
  const std::vector<Vector3d> across = points(b);
  std::vector<Band> pieces;
  std::size_t from_a = 0, from_b = 0;
  for (std::size_t i = 1; i < a.size(); ++i) {
    const Vector3d p = start(a[i]);
    const double gap = distance_to(across, p);
    for (std::size_t j = from_b + 1; j < b.size(); ++j) {
      if ((start(b[j]) - p).norm() > std::hypot(gap, slack)) continue;
      pieces.push_back(band(Chain(a.begin() + std::ptrdiff_t(from_a), a.begin() + std::ptrdiff_t(i)),
                            Chain(b.begin() + std::ptrdiff_t(from_b), b.begin() + std::ptrdiff_t(j))));
      from_a = i, from_b = j;
      break;
    }
  }
  pieces.push_back(
      band(Chain(a.begin() + std::ptrdiff_t(from_a), a.end()), Chain(b.begin() + std::ptrdiff_t(from_b), b.end())));
  return pieces;
}

/// Two sides that meet in two tips. With as many segments on each, nodes that are as far from a tip face each other;
/// otherwise chords of the one cross the other where it is thinner than an arch is high.
bool BandFinder::add_crescent(const Chain& loop) {
  constexpr double kTipTurn = 130;  // degrees
  const std::vector<std::size_t> tips = corners_of(model_, loop, kTipTurn);
  if (tips.size() != 2) return false;
  const Chain a = part(loop, tips[0], tips[1]), b = reversed(part(loop, tips[1], tips[0]));
  if (!face(a, b)) return false;
  for (Band& piece : in_pieces(a, b)) bands_.push_back(std::move(piece));
  return true;
}

/// Two closed curves with a common point, where a circle touches another from inside: both tips are there.
void BandFinder::add_pinched_ring(const std::vector<Index>& boundary) {
  if (boundary.size() != 2 || boundary[0] == boundary[1]) return;
  const int tip = curve(boundary[0]).ends[0];
  for (Index c : boundary)
    for (int end : curve(c).ends)
      if (end != tip) return;
  const Chain a{{boundary[0], false}}, b{{boundary[1], false}};
  if (face(a, b)) add(a, b);
}

/// Two curves of the loop are the ends. Of several ways the one with the most equal sides.
bool BandFinder::add_strip(const Chain& loop) {
  if (loop.size() < 4 || loop.size() > kMostCurvesOfStrip) return false;
  struct Ends {
    double unlike;
    std::size_t i, j;
    bool operator<(const Ends& other) const {
      return std::tie(unlike, i, j) < std::tie(other.unlike, other.i, other.j);
    }
  };
  std::vector<Ends> candidates;
  for (std::size_t i = 0; i < loop.size(); ++i)
    for (std::size_t j = i + 2; j < loop.size() && (i > 0 || j + 1 < loop.size()); ++j) {
      const Chain a = part(loop, i + 1, j), b = part(loop, j + 1, i);
      const double la = length(a), lb = length(b);
      const double ends = std::max(curve(loop[i].curve).length, curve(loop[j].curve).length);
      if (ends > kThickest * size(a, b) || ends > std::min(la, lb)) continue;
      candidates.push_back({std::abs(std::log(la / lb)), i, j});
    }
  std::sort(candidates.begin(), candidates.end());
  constexpr std::size_t kMostTries = 4;
  for (std::size_t k = 0; k < std::min(kMostTries, candidates.size()); ++k) {
    const auto [unlike, i, j] = candidates[k];
    const Chain a = part(loop, i + 1, j), b = reversed(part(loop, j + 1, i));
    if (!face(a, b)) continue;
    for (Band& piece : in_pieces(a, b)) bands_.push_back(std::move(piece));
    add({loop[i]}, {loop[j]});
    return true;
  }
  return false;
}

void BandFinder::add_four_sides(const Chain& loop) {
  constexpr double kTurn = 45;  // degrees
  const std::vector<std::size_t> corners = corners_of(model_, loop, kTurn);
  if (corners.size() != 4) return;
  for (std::size_t k : {0, 1}) {
    const Chain a = part(loop, corners[k], corners[k + 1]),
                b = reversed(part(loop, corners[k + 2], corners[(k + 3) % 4]));
    const int na = segments(a), nb = segments(b);
    if (std::max(na, nb) <= kNearlySame * std::min(na, nb) || std::abs(na - nb) <= 1) add(a, b);
  }
}

/// The distance between the ends of straight curves in a row, or 0 if they are not straight.
double straight_length(const CurveModel& model, const std::vector<Index>& side) {
  constexpr double kStraight = 1e-6;
  double length = 0, farthest = 0;
  for (Index c : side) {
    length += model.curves[c].length;
    for (Index d : side)
      for (const Vector3d& p : {model.curves[c].points.front(), model.curves[c].points.back()})
        for (const Vector3d& q : {model.curves[d].points.front(), model.curves[d].points.back()})
          farthest = std::max(farthest, (p - q).norm());
  }
  return farthest >= (1 - kStraight) * length ? farthest : 0;
}

/// True of a straight side of a ring between right-angled corners, where the outer curves are longer by the thickness
/// at each end, if they also have a segment more for each row there: rows turn in a square of quads then. Along a
/// mitre, which equal numbers would give them, quads are poorer. A ring much thinner than its size has no room for
/// squares.
bool BandFinder::is_side_of_frame(const Band& band) const {
  constexpr double kSlack = 0.05;     // of the thickness
  constexpr double kThinnest = 0.75;  // sizes
  const double one = straight_length(model_, band.one), other = straight_length(model_, band.other);
  if (one == 0 || other == 0) return false;
  const std::vector<Index>&outer = one > other ? band.one : band.other, &inner = one > other ? band.other : band.one;
  const auto segments_of = [&](const std::vector<Index>& side) {
    int sum = 0;
    for (Index c : side) sum += curve(c).segments;
    return sum;
  };
  const Vector3d from = curve(inner.front()).points.front(), to = curve(inner.front()).points.back();
  const Vector3d along = (to - from).normalized(), across = curve(outer.front()).points.front() - from;
  const double thickness = (across - across.dot(along) * along).norm();
  const double in_sizes = thickness * (segments_of(outer) + segments_of(inner)) / (one + other);
  return in_sizes >= kThinnest && std::abs(std::abs(one - other) - 2 * thickness) <= kSlack * thickness &&
         segments_of(outer) - segments_of(inner) == 2 * int(std::round(in_sizes));
}

bool BandFinder::add_ring(const Chain& a, const Chain& b) {
  if (!face(a, b)) return false;
  // Two points across from each other are where both begin; which way the other runs shows at the next ones.
  std::vector<Band> best = {band(a, b)};
  const std::vector<Vector3d> across = points(b);
  for (std::size_t i = 0; i < a.size() && best.size() == 1; ++i) {
    const Vector3d p = start(a[i]);
    std::size_t nearest = 0;
    for (std::size_t j = 1; j < b.size(); ++j)
      if ((start(b[j]) - p).norm() < (start(b[nearest]) - p).norm()) nearest = j;
    if ((start(b[nearest]) - p).norm() > std::hypot(distance_to(across, p), 0.35 * size(a, b))) continue;
    Chain from_a = a, forward = b;
    std::rotate(from_a.begin(), from_a.begin() + std::ptrdiff_t(i), from_a.end());
    std::rotate(forward.begin(), forward.begin() + std::ptrdiff_t(nearest), forward.end());
    for (const Chain& other : {forward, reversed(forward)})
      if (std::vector<Band> pieces = in_pieces(from_a, other); pieces.size() > best.size()) best = std::move(pieces);
  }
  for (Band& piece : best)
    if (!is_side_of_frame(piece)) bands_.push_back(std::move(piece));
  return true;
}

bool BandFinder::face_from_end_to_end(Index a, Index b) const {
  const DividedCurve &c = curve(a), &d = curve(b);
  if (std::max(c.length, d.length) > kLongest * std::min(c.length, d.length)) return false;
  const double most = std::min(kThickest * (c.length + d.length) / (c.segments + d.segments), c.length / 2);
  const bool closed = c.ends[0] == c.ends[1];
  if (closed != (d.ends[0] == d.ends[1])) return false;
  if (closed) {
    const double off = (c.points[c.points.size() / 4] - d.points.front()).norm();
    if (off > c.length + most) return false;
    return is_near({{a, false}}, {{b, false}}, most) && is_near({{b, false}}, {{a, false}}, most);
  }
  for (int end : c.ends)
    if (end == d.ends[0] || end == d.ends[1]) return false;
  const auto gap = [&](bool turned) {
    return std::max((c.points.front() - (turned ? d.points.back() : d.points.front())).norm(),
                    (c.points.back() - (turned ? d.points.front() : d.points.back())).norm());
  };
  if (std::min(gap(false), gap(true)) > most) return false;
  return is_near({{a, false}}, {{b, false}}, most) && is_near({{b, false}}, {{a, false}}, most);
}

void BandFinder::add_pairs(const std::vector<Index>& boundary) {
  std::vector<Index> curves;
  for (Index c : boundary)
    if (curve(c).segments > 1) curves.push_back(c);
  sort_unique(curves);
  for (std::size_t i = 0; i < curves.size(); ++i)
    for (std::size_t j = i + 1; j < curves.size(); ++j)
      if (face_from_end_to_end(curves[i], curves[j])) add({{curves[i], false}}, {{curves[j], false}});
}

void BandFinder::look_at(Index surface) {
  surface_ = surface;
  std::vector<Index> boundary = model_.surfaces[surface].boundary;
  std::erase_if(boundary, [&](Index c) { return curve(c).segments == 0; });
  const std::vector<Chain> loops = loops_of(model_, boundary);
  const std::size_t before = bands_.size();
  if (loops.size() == 2 && add_ring(loops[0], loops[1])) return;
  if (loops.size() == 1 && !add_crescent(loops[0]) && !add_strip(loops[0])) add_four_sides(loops[0]);
  if (loops.empty()) add_pinched_ring(boundary);
  if (bands_.size() > before) return;
  surface_ = kNone;  // the rest of the surface has a part in the band's ends
  add_pairs(boundary);
}

}  // namespace

std::vector<Band> find_bands(const CurveModel& model) {
  BandFinder finder(model);
  for (Index s = 0; s < model.surfaces.size(); ++s) finder.look_at(s);
  return finder.take();
}

}  // namespace qmorph::adapter
