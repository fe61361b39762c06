#include "smoothing/node_energy.hpp"

#include <cmath>
#include <limits>

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

/// The sum of mu^2 over corners and, twice as large as they are here, its derivatives with respect to the node. With
/// mu = n / (2 J), n = |a|^2 + |b|^2 and J = a x b linear in the node: grad mu = g = (dn / 2 - mu dJ) / J,
/// Hess mu = (n2 / 2 - g dJ^T - dJ g^T) / J.
struct Sum {
  double value = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;

  /// The corner with edges (ax, ay) and (bx, by); (dx, dy) is half the gradient of n, (jx, jy) the gradient of J, `half_n2` half
  /// the diagonal of the second derivative of n.
  bool add(double ax, double ay, double bx, double by, double dx, double dy, double half_n2, double jx, double jy) {
    const double j = ax * by - ay * bx, n = ax * ax + ay * ay + bx * bx + by * by;
    if (!(n < 2 * kMostMu * j)) return false;
    const double inverse = 1 / j, mu = 0.5 * n * inverse, k = mu * inverse;
    const double gx = inverse * (dx - mu * jx), gy = inverse * (dy - mu * jy);
    value += mu * mu;
    x += mu * gx, y += mu * gy;
    xx += gx * gx + k * (half_n2 - 2 * gx * jx);
    yy += gy * gy + k * (half_n2 - 2 * gy * jy);
    xy += gx * gy - k * (gx * jy + gy * jx);
    return true;
  }
};

/// mu^2 of a corner, or infinity where it may be straight.
double squared_mu(const Vec2& a, const Vec2& b) {
  const double j = cross(a, b), n = a.squaredNorm() + b.squaredNorm();
  if (!(n < 2 * kMostMu * j)) return std::numeric_limits<double>::infinity();
  const double mu = n / (2 * j);
  return mu * mu;
}

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

Energy energy_around(const kernel::Mesh& mesh, Index v) {
  const double px = mesh.point(v).x(), py = mesh.point(v).y();
  Sum sum;
  Energy energy;
  energy.finite =
      for_each_element(mesh, v, [&](const Vec2& q, const Vec2& after_q, const Vec2& before_r, const Vec2& r) {
        const double qx = q.x() - px, qy = q.y() - py, rx = r.x() - px, ry = r.y() - py;
        const double sx = after_q.x() - q.x(), sy = after_q.y() - q.y(), tx = before_r.x() - r.x(),
                     ty = before_r.y() - r.y();
        return sum.add(qx, qy, rx, ry, -(qx + rx), -(qy + ry), 2, qy - ry, rx - qx) &&
               sum.add(sx, sy, -qx, -qy, -qx, -qy, 1, -sy, sx) && sum.add(-rx, -ry, tx, ty, -rx, -ry, 1, ty, -tx);
      });
  energy.value = sum.value;
  energy.gradient = {2 * sum.x, 2 * sum.y};
  energy.xx = 2 * sum.xx, energy.yy = 2 * sum.yy, energy.xy = 2 * sum.xy;
  return energy;
}

Energy energy_at(const kernel::Mesh& mesh, Index v, const Vec2& p) {
  Energy energy;
  energy.finite =
      for_each_element(mesh, v, [&](const Vec2& q, const Vec2& after_q, const Vec2& before_r, const Vec2& r) {
        energy.value += squared_mu(q - p, r - p) + squared_mu(after_q - q, p - q) + squared_mu(p - r, before_r - r);
        return energy.value < std::numeric_limits<double>::infinity();
      });
  return energy;
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
