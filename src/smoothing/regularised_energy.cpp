// SPDX-License-Identifier: GPL-2.0-or-later
// The part of Star that works where corners are turned over.
#include <algorithm>
#include <cmath>

#include "smoothing/node_energy.hpp"

namespace qmorph::smoothing {
namespace {

/// How a corner's area J enters the energy: as h(J).
[[gnu::always_inline]] inline void regularise(const FourLanes& j, double delta, FourLanes& root, FourLanes& h) {
  root = j * j + 4 * delta * delta;
  for (int i = 0; i < 4; ++i) root[i] = std::sqrt(root[i]);
  // For negative j the sum cancels: its conjugate does not.
  h = j >= 0 ? 0.5 * (j + root) : 2 * delta * delta / (root - j);
}

/// What a corner adds to the energy and its derivatives, in four elements.
struct Terms {
  FourLanes value, x, y, xx, yy, xy;
};

/// mu^2 of the corners with edges a, b. (nx, ny) and (jx, jy) are the gradients of |a|^2 + |b|^2 and of a x b with
/// respect to the node, `n2` the diagonal of the (constant) second derivative of the first.
[[gnu::always_inline]] inline void find_terms(Terms& t, double delta, const FourLanes& ax, const FourLanes& ay,
                                              const FourLanes& bx, const FourLanes& by, const FourLanes& nx,
                                              const FourLanes& ny, double n2, const FourLanes& jx,
                                              const FourLanes& jy) {
  FourLanes root, h;
  regularise(ax * by - ay * bx, delta, root, h);
  const FourLanes dh = h / root, ddh = 2 * delta * delta / (root * root * root);
  const FourLanes n = (ax * ax + ay * ay) + (bx * bx + by * by);
  const FourLanes inverse = 0.5 / h, mu = n * inverse, fall = 2 * mu * dh;
  const FourLanes gx = inverse * (nx - fall * jx), gy = inverse * (ny - fall * jy);
  // Second derivative of mu: diagonal + mixed (dn dj^T + dj dn^T) + outer dj dj^T; then that of mu^2.
  const FourLanes diagonal = n2 * inverse, mixed = -2 * dh * inverse * inverse,
                  outer = 4 * mu * inverse * inverse * (2 * dh * dh - h * ddh);
  t.value = mu * mu, t.x = 2 * mu * gx, t.y = 2 * mu * gy;
  t.xx = 2 * (mu * (diagonal + 2 * mixed * nx * jx + outer * jx * jx) + gx * gx);
  t.yy = 2 * (mu * (diagonal + 2 * mixed * ny * jy + outer * jy * jy) + gy * gy);
  t.xy = 2 * (mu * (mixed * (nx * jy + ny * jx) + outer * jx * jy) + gx * gy);
}

/// mu^2 alone.
[[gnu::always_inline]] inline void find_value(FourLanes& value, double delta, const FourLanes& ax, const FourLanes& ay,
                                              const FourLanes& bx, const FourLanes& by) {
  FourLanes root, h;
  regularise(ax * by - ay * bx, delta, root, h);
  const FourLanes mu = ((ax * ax + ay * ay) + (bx * bx + by * by)) / (2 * h);
  value = mu * mu;
}

/// Element after element, corner after corner, so that the sum has the same rounding on every processor.
QMORPH_WIDE void add_derivatives(Energy& energy, const FourElements& e, std::size_t count, const Vec2& p,
                                 double delta) {
  const FourLanes qx = e.qx - p.x(), qy = e.qy - p.y(), rx = e.rx - p.x(), ry = e.ry - p.y();
  const FourLanes sx = e.after_qx - e.qx, sy = e.after_qy - e.qy, tx = e.before_rx - e.rx, ty = e.before_ry - e.ry;
  Terms corners[3];
  find_terms(corners[0], delta, qx, qy, rx, ry, -2 * (qx + rx), -2 * (qy + ry), 4, e.qy - e.ry, -(e.qx - e.rx));
  find_terms(corners[1], delta, sx, sy, -qx, -qy, -2 * qx, -2 * qy, 2, -sy, sx);
  find_terms(corners[2], delta, -rx, -ry, tx, ty, -2 * rx, -2 * ry, 2, ty, -tx);
  for (std::size_t i = 0; i < std::min<std::size_t>(count, 4); ++i)
    for (const Terms& t : corners) {
      energy.value += t.value[i];
      energy.gradient += Vec2(t.x[i], t.y[i]);
      energy.xx += t.xx[i], energy.yy += t.yy[i], energy.xy += t.xy[i];
    }
}

QMORPH_WIDE void add_value(double& value, const FourElements& e, std::size_t count, const Vec2& p, double delta) {
  const FourLanes qx = e.qx - p.x(), qy = e.qy - p.y(), rx = e.rx - p.x(), ry = e.ry - p.y();
  FourLanes at_node, at_q, at_r;
  find_value(at_node, delta, qx, qy, rx, ry);
  find_value(at_q, delta, e.after_qx - e.qx, e.after_qy - e.qy, -qx, -qy);
  find_value(at_r, delta, -rx, -ry, e.before_rx - e.rx, e.before_ry - e.ry);
  const FourLanes sum = at_node + at_q + at_r;
  for (std::size_t i = 0; i < std::min<std::size_t>(count, 4); ++i) value += sum[i];
}

}  // namespace

constexpr std::size_t kWork = 2;  // of an element, in those without the square root

Energy Star::regularised_with_derivatives(const Vec2& p, double delta) const {
  Energy energy;
  work_ += kWork * count_;
  for (std::size_t i = 0; i < count_; i += 4) add_derivatives(energy, fours_[i / 4], count_ - i, p, delta);
  return energy;
}

double Star::regularised(const Vec2& p, double delta) const {
  double value = 0;
  work_ += kWork * count_;
  for (std::size_t i = 0; i < count_; i += 4) add_value(value, fours_[i / 4], count_ - i, p, delta);
  return value;
}

double Star::mean_edge(const Vec2& p) const {
  double sum = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const FourElements& four = fours_[i / 4];
    sum += Vec2(four.qx[i % 4] - p.x(), four.qy[i % 4] - p.y()).norm();
  }
  return sum / double(count_);
}

}  // namespace qmorph::smoothing
