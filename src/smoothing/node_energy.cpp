#include "smoothing/node_energy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/predicates.hpp"

namespace qmorph::smoothing {
namespace {

/// Calls corners(q, after_q, before_r, r) for each element around v, which runs v, q, ..., r: its corners at v, q and r depend
/// on v. Stops when that returns false.
template <class Corners>
bool for_each_element(const kernel::Mesh& mesh, Index v, const Corners& corners) {
  const Index start = mesh.out(v);
  Index h = start;
  do {
    if (mesh.face(h) != kNone) {
      const Index to_v = mesh.prev(h);
      if (!corners(mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))),
                   mesh.point(mesh.origin(mesh.prev(to_v))), mesh.point(mesh.origin(to_v))))
        return false;
    }
    h = mesh.rotate_ccw(h);
  } while (h != start);
  return true;
}

/// mu is at least 1 / sine: a corner whose mu is larger than this may be straight.
constexpr double kMostMu = 0.5 / kStraightSine;

/// One number for each of two elements, so that the processor works on both at once.
using Lanes = Eigen::Array2d;

/// A corner of two elements: mu^2 and, half as large as they are, its derivatives with respect to the node. With
/// mu = n / (2 J), n = |a|^2 + |b|^2 and J = a x b linear in the node: grad mu = g = (dn / 2 - mu dJ) / J,
/// Hess mu = (n2 / 2 - g dJ^T - dJ g^T) / J.
struct CornerTerms {
  Lanes value, x, y, xx, yy, xy;
  std::array<bool, 2> finite;

  /// The corner with edges (ax, ay) and (bx, by); (dx, dy) is half the gradient of n, (jx, jy) the gradient of J, `half_n2` half
  /// the diagonal of the second derivative of n.
  [[gnu::always_inline]] CornerTerms(const Lanes& ax, const Lanes& ay, const Lanes& bx, const Lanes& by,
                                     const Lanes& dx, const Lanes& dy, double half_n2, const Lanes& jx,
                                     const Lanes& jy) {
    const Lanes j = ax * by - ay * bx, n = ax * ax + ay * ay + bx * bx + by * by;
    const Lanes most = 2 * kMostMu * j;
    finite = {n[0] < most[0], n[1] < most[1]};
    const Lanes inverse = 1 / j, mu = 0.5 * n * inverse, k = mu * inverse;
    const Lanes gx = inverse * (dx - mu * jx), gy = inverse * (dy - mu * jy);
    value = mu * mu;
    x = mu * gx, y = mu * gy;
    xx = gx * gx + k * (half_n2 - 2 * gx * jx);
    yy = gy * gy + k * (half_n2 - 2 * gy * jy);
    xy = gx * gy - k * (gx * jy + gy * jx);
  }
};

/// The sum over corners, always in the same order.
struct Sum {
  Lanes value_x{0, 0}, y_xy{0, 0}, xx_yy{0, 0};

  void add(const CornerTerms& terms, std::size_t lane) {
    value_x += Lanes{terms.value[lane], terms.x[lane]};
    y_xy += Lanes{terms.y[lane], terms.xy[lane]};
    xx_yy += Lanes{terms.xx[lane], terms.yy[lane]};
  }
};

/// mu of a corner of two elements, from its area and the squares of its edges; not finite where it may be straight.
struct CornerMu {
  Lanes squared;
  std::array<bool, 2> finite;

  CornerMu(const Lanes& j, const Lanes& n) {
    const Lanes most = 2 * kMostMu * j;
    finite = {n[0] < most[0], n[1] < most[1]};
    const Lanes mu = n / (2 * j);
    squared = mu * mu;
  }
};

/// How a corner's area J enters the regularised energy: as h(J), with the first two derivatives. [Escobar03]
struct Regularised {
  double delta;
  double root(double j) const { return std::sqrt(j * j + 4 * delta * delta); }
  double h(double j) const {
    // For negative j the sum cancels: its conjugate does not.
    return j >= 0 ? 0.5 * (j + root(j)) : 2 * delta * delta / (root(j) - j);
  }
  double dh(double j) const { return h(j) / root(j); }
  double ddh(double j) const {
    const double r = root(j);
    return 2 * delta * delta / (r * r * r);
  }
};

/// Adds mu^2 of the corner with edges a, b. `dn` and `dj` are the gradients of |a|^2 + |b|^2 and of a x b with
/// respect to the node, `n2` the diagonal of the (constant) second derivative of the first.
void add_corner(Energy& energy, const Regularised& area, const Vec2& a, const Vec2& b, const Vec2& dn, double n2,
                const Vec2& dj) {
  const double j = cross(a, b), n = a.squaredNorm() + b.squaredNorm();
  const double h = area.h(j), dh = area.dh(j), inverse = 0.5 / h, mu = n * inverse;
  const Vec2 g = inverse * (dn - (2 * mu * dh) * dj);
  // Second derivative of mu: diagonal + mixed (dn dj^T + dj dn^T) + outer dj dj^T; then that of mu^2.
  const double diagonal = n2 * inverse, mixed = -2 * dh * inverse * inverse,
               outer = 4 * mu * inverse * inverse * (2 * dh * dh - h * area.ddh(j));
  energy.value += mu * mu;
  energy.gradient += (2 * mu) * g;
  energy.xx += 2 * (mu * (diagonal + 2 * mixed * dn.x() * dj.x() + outer * dj.x() * dj.x()) + g.x() * g.x());
  energy.yy += 2 * (mu * (diagonal + 2 * mixed * dn.y() * dj.y() + outer * dj.y() * dj.y()) + g.y() * g.y());
  energy.xy += 2 * (mu * (mixed * (dn.x() * dj.y() + dn.y() * dj.x()) + outer * dj.x() * dj.y()) + g.x() * g.y());
}

double squared_mu(const Regularised& area, const Vec2& a, const Vec2& b) {
  const double mu = (a.squaredNorm() + b.squaredNorm()) / (2 * area.h(cross(a, b)));
  return mu * mu;
}

Vec2 clockwise(const Vec2& v) { return {v.y(), -v.x()}; }

}  // namespace

/// Edges of two elements: (qx, qy) and (rx, ry) from the node's neighbours in the element to the node, (sx, sy) and (tx, ty) from
/// these neighbours on.
struct Star::Two {
  Lanes qx, qy, rx, ry, sx, sy, tx, ty;

  /// Elements `first` and the next of the star with the node at p.
  [[gnu::always_inline]] Two(const Vec2& p, const Element* first) {
    const Element &a = first[0], &b = first[1], &c = first[2];
    qx = p.x() - Lanes{a.q.x(), b.q.x()}, qy = p.y() - Lanes{a.q.y(), b.q.y()};
    rx = p.x() - Lanes{b.q.x(), c.q.x()}, ry = p.y() - Lanes{b.q.y(), c.q.y()};
    sx = {a.s.x(), b.s.x()}, sy = {a.s.y(), b.s.y()};
    tx = {a.t.x(), b.t.x()}, ty = {a.t.y(), b.t.y()};
  }
};

void Star::look_around(const kernel::Mesh& mesh, Index v) {
  const Index end = mesh.out(v);
  Index h = mesh.face(end) == kNone ? mesh.rotate_ccw(end) : end;  // from here on there are no gaps
  Vec2 q = mesh.point(mesh.target(h));
  count_ = 0;
  do {
    if (elements_.size() < count_ + 3) elements_.resize(2 * count_ + 16);
    const Index to_v = mesh.prev(h);
    const Vec2 r = mesh.point(mesh.origin(to_v));
    elements_[count_++] = {q, mesh.point(mesh.target(mesh.next(h))) - q, mesh.point(mesh.origin(mesh.prev(to_v))) - r};
    q = r;
    h = kernel::Mesh::twin(to_v);
  } while (h != end);
  elements_[count_].q = q;
}

Energy Star::energy_with_derivatives(const Vec2& p) const {
  Sum sum;
  Energy energy;
  for (std::size_t i = 0; i < count_; i += 2) {
    const Two e(p, &elements_[i]);
    const CornerTerms at_v(e.qx, e.qy, e.rx, e.ry, e.qx + e.rx, e.qy + e.ry, 2, e.ry - e.qy, e.qx - e.rx);
    const CornerTerms at_q(e.sx, e.sy, e.qx, e.qy, e.qx, e.qy, 1, -e.sy, e.sx);
    const CornerTerms at_r(e.rx, e.ry, e.tx, e.ty, e.rx, e.ry, 1, e.ty, -e.tx);
    for (std::size_t lane = 0; lane < std::min<std::size_t>(2, count_ - i); ++lane) {
      if (!at_v.finite[lane] || !at_q.finite[lane] || !at_r.finite[lane]) return energy.finite = false, energy;
      sum.add(at_v, lane), sum.add(at_q, lane), sum.add(at_r, lane);
    }
  }
  energy.value = sum.value_x[0];
  energy.gradient = {2 * sum.value_x[1], 2 * sum.y_xy[0]};
  energy.xx = 2 * sum.xx_yy[0], energy.yy = 2 * sum.xx_yy[1], energy.xy = 2 * sum.y_xy[1];
  return energy;
}

Energy Star::energy(const Vec2& p) const {
  Energy energy;
  for (std::size_t i = 0; i < count_; i += 2) {
    const Two e(p, &elements_[i]);
    const Lanes qq = e.qx * e.qx + e.qy * e.qy, rr = e.rx * e.rx + e.ry * e.ry;
    const CornerMu at_v(e.qx * e.ry - e.qy * e.rx, qq + rr);
    const CornerMu at_q(e.sx * e.qy - e.sy * e.qx, e.sx * e.sx + e.sy * e.sy + qq);
    const CornerMu at_r(e.rx * e.ty - e.ry * e.tx, rr + (e.tx * e.tx + e.ty * e.ty));
    const Lanes value = at_v.squared + at_q.squared + at_r.squared;
    for (std::size_t lane = 0; lane < std::min<std::size_t>(2, count_ - i); ++lane) {
      if (!at_v.finite[lane] || !at_q.finite[lane] || !at_r.finite[lane]) return energy.finite = false, energy;
      energy.value += value[lane];
    }
  }
  return energy;
}

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

Energy regularised_energy_around(const kernel::Mesh& mesh, Index v, double delta) {
  const Regularised area{delta};
  const Vec2& p = mesh.point(v);
  Energy energy;
  for_each_element(mesh, v, [&](const Vec2& q, const Vec2& after_q, const Vec2& before_r, const Vec2& r) {
    const Vec2 e1 = q - p, e2 = r - p;
    add_corner(energy, area, e1, e2, -2 * (e1 + e2), 4, clockwise(q - r));
    // At q: edges to the next corner and back to v; v is the end of the second. At r: v is the end of the first.
    add_corner(energy, area, after_q - q, -e1, -2 * e1, 2, -clockwise(after_q - q));
    add_corner(energy, area, -e2, before_r - r, -2 * e2, 2, clockwise(before_r - r));
    return true;
  });
  return energy;
}

double regularised_energy_at(const kernel::Mesh& mesh, Index v, const Vec2& p, double delta) {
  const Regularised area{delta};
  double value = 0;
  for_each_element(mesh, v, [&](const Vec2& q, const Vec2& after_q, const Vec2& before_r, const Vec2& r) {
    value +=
        squared_mu(area, q - p, r - p) + squared_mu(area, after_q - q, p - q) + squared_mu(area, p - r, before_r - r);
    return true;
  });
  return value;
}

}  // namespace qmorph::smoothing
