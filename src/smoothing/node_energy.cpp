// SPDX-License-Identifier: GPL-2.0-or-later
#include "smoothing/node_energy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/predicates.hpp"

namespace qmorph::smoothing {
namespace {

/// mu is at least 1 / sine: a corner whose mu is larger than this may be straight.
constexpr double kMostMu = 0.5 / kStraightSine;

/// What the corners of four elements add to the energy, and half of what they add to its derivatives with respect to
/// the node.
///
/// With mu = n / (2 J), n = |a|^2 + |b|^2 of the corner's edges and J = a x b linear in the node, the gradient of mu is
/// g = d / J - f, and half the Hessian of mu^2 is g g^T - f g^T - g f^T + k m I, where d is half the gradient of n, m
/// half the diagonal of its second derivative, k = mu / J and f = k dJ.
struct Derivatives {
  FourLanes value{}, x{}, y{}, xx{}, yy{}, xy{};
  FourLanes least{1, 1, 1, 1};  ///< of the areas J

  /// (dx, dy) is d, (jx, jy) is dJ.
  [[gnu::always_inline]] void add(const FourLanes& j, const FourLanes& n, const FourLanes& dx, const FourLanes& dy,
                                  double m, const FourLanes& jx, const FourLanes& jy) {
    least = j < least ? j : least;
    const FourLanes inverse = 1 / j, mu = 0.5 * n * inverse, k = mu * inverse, km = m * k;
    const FourLanes fx = k * jx, fy = k * jy, gx = inverse * dx - fx, gy = inverse * dy - fy;
    value += mu * mu;
    x += mu * gx, y += mu * gy;
    xx += gx * (gx - 2 * fx) + km, yy += gy * (gy - 2 * fy) + km, xy += gx * (gy - fy) - fx * gy;
  }
};

/// What they add to the energy, alone.
struct Value {
  FourLanes value{}, least{1, 1, 1, 1};

  [[gnu::always_inline]] void add(const FourLanes& j, const FourLanes& n, const FourLanes&, const FourLanes&, double,
                                  const FourLanes&, const FourLanes&) {
    least = j < least ? j : least;
    const FourLanes mu = 0.5 * n / j;
    value += mu * mu;
  }
};

/// Adds the three corners of four elements to Derivatives or Value, with the node at p.
template <class Sum>
[[gnu::always_inline]] inline void add_corners(Sum& sum, const FourElements& e, const Vec2& p) {
  const FourLanes qx = p.x() - e.qx, qy = p.y() - e.qy, rx = p.x() - e.rx, ry = p.y() - e.ry;
  const FourLanes qq = qx * qx + qy * qy, rr = rx * rx + ry * ry;
  const FourLanes sx = e.after_qx - e.qx, sy = e.after_qy - e.qy, tx = e.before_rx - e.rx, ty = e.before_ry - e.ry;
  const FourLanes ss = sx * sx + sy * sy, tt = tx * tx + ty * ty;
  sum.add(qx * ry - qy * rx, qq + rr, qx + rx, qy + ry, 2, ry - qy, qx - rx);
  sum.add(sx * qy - sy * qx, ss + qq, qx, qy, 1, -sy, sx);
  sum.add(rx * ty - ry * tx, rr + tt, rx, ry, 1, ty, -tx);
}

/// Sum of the first `count` lanes; the others hold no element.
[[gnu::always_inline]] inline double sum_of(const FourLanes& lanes, std::size_t count) {
  const FourLanes used = FourLanes{0, 1, 2, 3} < double(count) ? lanes : FourLanes{};
  return (used[0] + used[1]) + (used[2] + used[3]);
}

/// Whether the first `count` lanes are all positive.
[[gnu::always_inline]] inline bool are_positive(const FourLanes& lanes, std::size_t count) {
  const FourLanes used = FourLanes{0, 1, 2, 3} < double(count) ? lanes : FourLanes{1, 1, 1, 1};
  return used[0] > 0 && used[1] > 0 && used[2] > 0 && used[3] > 0;
}

QMORPH_WIDE void add_derivatives(Energy& energy, const FourElements& elements, std::size_t count, const Vec2& p) {
  Derivatives half;
  add_corners(half, elements, p);
  energy.finite = energy.finite && are_positive(half.least, count);
  energy.value += sum_of(half.value, count);
  energy.gradient += 2 * Vec2(sum_of(half.x, count), sum_of(half.y, count));
  energy.xx += 2 * sum_of(half.xx, count);
  energy.yy += 2 * sum_of(half.yy, count);
  energy.xy += 2 * sum_of(half.xy, count);
}

QMORPH_WIDE void add_value(Energy& energy, const FourElements& elements, std::size_t count, const Vec2& p) {
  Value sum;
  add_corners(sum, elements, p);
  energy.finite = energy.finite && are_positive(sum.least, count);
  energy.value += sum_of(sum.value, count);
}

}  // namespace

[[gnu::always_inline]] inline void Star::put(std::size_t place, const Vec2& q, const Vec2& after_q,
                                             const Vec2& before_r, const Vec2& r, Index node, Index opposite) {
  if (place == 4 * fours_.size()) fours_.emplace_back();
  FourElements& four = fours_[place / 4];
  const std::size_t lane = place % 4;
  four.qx[lane] = q.x(), four.qy[lane] = q.y();
  four.rx[lane] = r.x(), four.ry[lane] = r.y();
  four.after_qx[lane] = after_q.x(), four.after_qy[lane] = after_q.y();
  four.before_rx[lane] = before_r.x(), four.before_ry[lane] = before_r.y();
  four.node[lane] = node, four.opposite[lane] = opposite;
}

void Star::look_around(const kernel::Mesh& mesh, Index v) {
  const Index end = mesh.out(v);
  Index h = mesh.face(end) == kNone ? mesh.rotate_ccw(end) : end;  // from here on there are no gaps
  Index node = mesh.target(h);
  std::size_t count = 0;
  do {
    const Index to_v = mesh.prev(h), next_node = mesh.origin(to_v), opposite = mesh.origin(mesh.prev(to_v));
    const Vec2 &q = mesh.point(node), &r = mesh.point(next_node), &before_r = mesh.point(opposite);
    const Vec2& after_q = opposite == node ? r : before_r;  // in a triangle
    put(count++, q, after_q, before_r, r, node, opposite);
    node = next_node;
    h = kernel::Mesh::twin(to_v);
  } while (h != end);
  count_ = count;
}

void Star::set(std::span<const StarElement> elements) {
  count_ = 0;
  for (const StarElement& e : elements) put(count_++, e.q, e.after_q, e.before_r, e.r, e.node, e.opposite);
}

template <class Add>
Energy Star::sum(const Vec2& p, const Add& add) const {
  Energy energy;
  work_ += count_;
  for (std::size_t i = 0; i < count_; i += 4) add(energy, fours_[i / 4], count_ - i, p);
  energy.finite = energy.finite && energy.value < kMostMu * kMostMu;  // and so is each square
  return energy;
}

Energy Star::energy_with_derivatives(const Vec2& p) const { return sum(p, add_derivatives); }

Energy Star::energy(const Vec2& p) const { return sum(p, add_value); }

Energy energy_around(const kernel::Mesh& mesh, Index v) {
  Star star;
  star.look_around(mesh, v);
  return star.energy_with_derivatives(mesh.point(v));
}

Energy energy_at(const kernel::Mesh& mesh, Index v, const Vec2& p) {
  Star star;
  star.look_around(mesh, v);
  return star.energy(p);
}

}  // namespace qmorph::smoothing
