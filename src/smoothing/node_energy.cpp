#include "smoothing/node_energy.hpp"

#include <cmath>

#include "geometry/predicates.hpp"

namespace qmorph::smoothing {
namespace {

/// How a corner's area J enters its energy: as h(J), with the first two derivatives.
struct Plain {
  /// mu is at least 1 / sine: a corner whose mu is larger than this may be straight.
  static constexpr double kMostMu = 0.5 / kStraightSine;
  bool accepts(double j, double n) const { return n < 2 * kMostMu * j; }
  double h(double j) const { return j; }
  double dh(double) const { return 1; }
  double ddh(double) const { return 0; }
};
struct Regularised {
  double delta;
  double root(double j) const { return std::sqrt(j * j + 4 * delta * delta); }
  bool accepts(double, double) const { return true; }
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
template <class Area>
void add_corner(Energy& energy, const Area& area, const Vec2& a, const Vec2& b, const Vec2& dn,
                double n2, const Vec2& dj) {
  const double j = cross(a, b), n = a.squaredNorm() + b.squaredNorm();
  if (!area.accepts(j, n)) {
    energy.finite = false;
    return;
  }
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

template <class Area>
void add_value(Energy& energy, const Area& area, const Vec2& a, const Vec2& b) {
  const double j = cross(a, b), n = a.squaredNorm() + b.squaredNorm();
  if (!area.accepts(j, n)) {
    energy.finite = false;
    return;
  }
  const double mu = n / (2 * area.h(j));
  energy.value += mu * mu;
}

Vec2 clockwise(const Vec2& v) { return {v.y(), -v.x()}; }

template <class Area>
Energy around(const kernel::Mesh& mesh, Index v, const Area& area) {
  Energy energy;
  const Vec2& p = mesh.point(v);
  Index h = mesh.out(v);
  do {
    if (mesh.face(h) != kNone) {
      // Around the face: v, q, (s, ...), r. The corners at v, q and r depend on v.
      const Index to_q = h, from_q = mesh.next(h), to_v = mesh.prev(h);
      const Vec2 &q = mesh.point(mesh.target(to_q)), &r = mesh.point(mesh.origin(to_v));
      const Vec2 &after_q = mesh.point(mesh.target(from_q)),
                 &before_r = mesh.point(mesh.origin(mesh.prev(to_v)));
      const Vec2 e1 = q - p, e2 = r - p;
      add_corner(energy, area, e1, e2, -2 * (e1 + e2), 4, clockwise(q - r));
      // At q: edges to the next corner and back to v; v is the end of the second.
      const Vec2 q1 = after_q - q, q2 = p - q;
      add_corner(energy, area, q1, q2, 2 * q2, 2, -clockwise(q1));
      // At r: edges to v and back to the corner before; v is the end of the first.
      const Vec2 r1 = p - r, r2 = before_r - r;
      add_corner(energy, area, r1, r2, 2 * r1, 2, clockwise(r2));
    }
    h = mesh.rotate_ccw(h);
  } while (h != mesh.out(v));
  return energy;
}

template <class Area>
Energy at(const kernel::Mesh& mesh, Index v, const Vec2& p, const Area& area) {
  Energy energy;
  Index h = mesh.out(v);
  do {
    if (mesh.face(h) != kNone) {
      const Index from_q = mesh.next(h), to_v = mesh.prev(h);
      const Vec2 &q = mesh.point(mesh.target(h)), &r = mesh.point(mesh.origin(to_v));
      add_value(energy, area, q - p, r - p);
      add_value(energy, area, mesh.point(mesh.target(from_q)) - q, p - q);
      add_value(energy, area, p - r, mesh.point(mesh.origin(mesh.prev(to_v))) - r);
      if (!energy.finite) return energy;
    }
    h = mesh.rotate_ccw(h);
  } while (h != mesh.out(v));
  return energy;
}

}  // namespace

Energy energy_around(const kernel::Mesh& mesh, Index v) { return around(mesh, v, Plain{}); }

Energy energy_at(const kernel::Mesh& mesh, Index v, const Vec2& p) {
  return at(mesh, v, p, Plain{});
}

Energy regularised_energy_around(const kernel::Mesh& mesh, Index v, double delta) {
  return around(mesh, v, Regularised{delta});
}

double regularised_energy_at(const kernel::Mesh& mesh, Index v, const Vec2& p, double delta) {
  return at(mesh, v, p, Regularised{delta}).value;
}

}  // namespace qmorph::smoothing
