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

/// Half of what the corners of two elements add: to the energy and its derivatives with respect to the node.
///
/// With mu = n / (2 J), n = |a|^2 + |b|^2 of the corner's edges and J = a x b linear in the node, half the gradient of mu^2 is
/// k (d - mu dJ), half its Hessian e e^T - f f^T + k m I, where d is half the gradient of n, m half the diagonal of its second
/// derivative, k = mu / J, f = k dJ and e = d / J - 2 f.
struct Sum {
  Lanes value{0, 0}, x{0, 0}, y{0, 0}, xx{0, 0}, yy{0, 0}, xy{0, 0};
  Lanes margin{1, 1};  ///< positive if no corner may be straight

  /// (dx, dy) is d, (jx, jy) is dJ.
  [[gnu::always_inline]] void add(const Lanes& j, const Lanes& n, const Lanes& dx, const Lanes& dy, double m,
                                  const Lanes& jx, const Lanes& jy) {
    margin = margin.min(2 * kMostMu * j - n);
    const Lanes inverse = 1 / j, mu = 0.5 * n * inverse, k = mu * inverse, km = m * k;
    const Lanes fx = k * jx, fy = k * jy, ex = inverse * dx - 2 * fx, ey = inverse * dy - 2 * fy;
    value += mu * mu;
    x += k * dx - mu * fx, y += k * dy - mu * fy;
    xx += ex * ex - fx * fx + km, yy += ey * ey - fy * fy + km, xy += ex * ey - fx * fy;
  }
  /// Adds what the first element has in `other`.
  void add_first(const Sum& other) {
    value[0] += other.value[0], x[0] += other.x[0], y[0] += other.y[0];
    xx[0] += other.xx[0], yy[0] += other.yy[0], xy[0] += other.xy[0];
    margin = margin.min(other.margin[0]);
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
  Index node = mesh.target(h);
  Vec2 q = mesh.point(node);
  count_ = 0;
  do {
    if (elements_.size() < count_ + 3) elements_.resize(2 * count_ + 16);
    const Index to_v = mesh.prev(h), next_node = mesh.origin(to_v), opposite = mesh.origin(mesh.prev(to_v));
    const Vec2 r = mesh.point(next_node);
    if (opposite != node) {
      const Vec2& o = mesh.point(opposite);
      elements_[count_++] = {q, o - q, o - r, node, opposite};
    } else {  // a triangle
      elements_[count_++] = {q, r - q, q - r, node, opposite};
    }
    node = next_node, q = r;
    h = kernel::Mesh::twin(to_v);
  } while (h != end);
  elements_[count_].q = q;
}

Energy Star::energy_with_derivatives(const Vec2& p) const {
  const auto add_two = [&](Sum & sum, std::size_t i) __attribute__((always_inline)) {
    const Two e(p, &elements_[i]);
    const Lanes qq = e.qx * e.qx + e.qy * e.qy, rr = e.rx * e.rx + e.ry * e.ry;
    const Lanes ss = e.sx * e.sx + e.sy * e.sy, tt = e.tx * e.tx + e.ty * e.ty;
    sum.add(e.qx * e.ry - e.qy * e.rx, qq + rr, e.qx + e.rx, e.qy + e.ry, 2, e.ry - e.qy, e.qx - e.rx);
    sum.add(e.sx * e.qy - e.sy * e.qx, ss + qq, e.qx, e.qy, 1, -e.sy, e.sx);
    sum.add(e.rx * e.ty - e.ry * e.tx, rr + tt, e.rx, e.ry, 1, e.ty, -e.tx);
  };
  Sum sum;
  for (std::size_t i = 0; i + 1 < count_; i += 2) add_two(sum, i);
  if (count_ % 2 != 0) {
    Sum last;  // its second lane is of no element
    add_two(last, count_ - 1);
    sum.add_first(last);
  }
  Energy energy;
  energy.finite = sum.margin.minCoeff() > 0;
  energy.value = sum.value.sum();
  energy.gradient = {2 * sum.x.sum(), 2 * sum.y.sum()};
  energy.xx = 2 * sum.xx.sum(), energy.yy = 2 * sum.yy.sum(), energy.xy = 2 * sum.xy.sum();
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
