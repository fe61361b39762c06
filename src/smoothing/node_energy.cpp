#include "smoothing/node_energy.hpp"

namespace qmorph::smoothing {
namespace {

using Matrix = Eigen::Matrix2d;

/// Adds mu^2 of the corner with edges a, b. `dn` and `dj` are the gradients of |a|^2 + |b|^2 and of a x b with
/// respect to the node, `n2` the diagonal of the (constant) second derivative of the first.
void add_corner(Energy& energy, const Vec2& a, const Vec2& b, const Vec2& dn, double n2,
                const Vec2& dj) {
  const double j = cross(a, b);
  if (!(j > 0)) {
    energy.finite = false;
    return;
  }
  const double n = a.squaredNorm() + b.squaredNorm(), mu = n / (2 * j);
  const Vec2 g = (dn - (n / j) * dj) / (2 * j);
  const Matrix outer = dn * dj.transpose();
  const Matrix h = n2 / (2 * j) * Matrix::Identity() - (outer + outer.transpose()) / (2 * j * j) +
                   n / (j * j * j) * dj * dj.transpose();
  energy.value += mu * mu;
  energy.gradient += 2 * mu * g;
  energy.hessian += 2 * (mu * h + g * g.transpose());
}

void add_value(Energy& energy, const Vec2& a, const Vec2& b) {
  const double j = cross(a, b);
  if (!(j > 0)) {
    energy.finite = false;
    return;
  }
  const double mu = (a.squaredNorm() + b.squaredNorm()) / (2 * j);
  energy.value += mu * mu;
}

Vec2 clockwise(const Vec2& v) { return {v.y(), -v.x()}; }

}  // namespace

Energy energy_around(const kernel::Mesh& mesh, Index v) {
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
      add_corner(energy, e1, e2, -2 * (e1 + e2), 4, clockwise(q - r));
      // At q: edges to the next corner and back to v; v is the end of the second.
      const Vec2 q1 = after_q - q, q2 = p - q;
      add_corner(energy, q1, q2, 2 * q2, 2, -clockwise(q1));
      // At r: edges to v and back to the corner before; v is the end of the first.
      const Vec2 r1 = p - r, r2 = before_r - r;
      add_corner(energy, r1, r2, 2 * r1, 2, clockwise(r2));
    }
    h = mesh.rotate_ccw(h);
  } while (h != mesh.out(v));
  return energy;
}

Energy energy_at(const kernel::Mesh& mesh, Index v, const Vec2& p) {
  Energy energy;
  Index h = mesh.out(v);
  do {
    if (mesh.face(h) != kNone) {
      const Index from_q = mesh.next(h), to_v = mesh.prev(h);
      const Vec2 &q = mesh.point(mesh.target(h)), &r = mesh.point(mesh.origin(to_v));
      add_value(energy, q - p, r - p);
      add_value(energy, mesh.point(mesh.target(from_q)) - q, p - q);
      add_value(energy, p - r, mesh.point(mesh.origin(mesh.prev(to_v))) - r);
      if (!energy.finite) return energy;
    }
    h = mesh.rotate_ccw(h);
  } while (h != mesh.out(v));
  return energy;
}

}  // namespace qmorph::smoothing
