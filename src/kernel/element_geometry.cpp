// SPDX-License-Identifier: GPL-2.0-or-later
// What Mesh says about the shape and size of its elements.
#include <algorithm>
#include <cmath>

#include "geometry/predicates.hpp"
#include "kernel/mesh.hpp"

namespace qmorph::kernel {
namespace {

/// sign(area) area^2 / product: a squared sine with the sign of the sine.
double signed_root(double area, double product) {
  if (!(product > 0)) return 0;
  const double sine = std::sqrt(area * area / product);
  return area < 0 ? -sine : sine;
}

/// Of a triangle: the smallest angle lies between the two longest sides.
double smallest_sine_of(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 ab = b - a, bc = c - b, ca = a - c;
  const double l1 = ab.squaredNorm(), l2 = bc.squaredNorm(), l3 = ca.squaredNorm();
  return signed_root(cross(ab, bc), std::max(std::max(l1 * l2, l2 * l3), l3 * l1));
}

/// Of a quad. Squares are compared as fractions: one root and one division at the end.
double smallest_sine_of(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 ab = b - a, bc = c - b, cd = d - c, da = a - d;
  const double l1 = ab.squaredNorm(), l2 = bc.squaredNorm(), l3 = cd.squaredNorm(), l4 = da.squaredNorm();
  const double areas[] = {cross(da, ab), cross(ab, bc), cross(bc, cd), cross(cd, da)};
  double products[] = {l4 * l1, l1 * l2, l2 * l3, l3 * l4};
  for (double& product : products)
    if (!(product > 0)) product = 1;  // a side without length: the area is 0 as well
  int least = 0;
  for (int i = 1; i < 4; ++i)
    if (areas[i] * std::abs(areas[i]) * products[least] < areas[least] * std::abs(areas[least]) * products[i])
      least = i;
  return signed_root(areas[least], products[least]);
}

}  // namespace

bool Mesh::is_valid_face(AnyFace f) const { return is_above(f, degree(f) == 3 ? kDegenerateSine : kStraightSine); }

bool Mesh::is_valid_star(AnyNode v) const { return is_star_above(v, kDegenerateSine, kStraightSine); }

bool Mesh::is_above(AnyFace f, double sine) const {
  const Index h = half_edge(f), k = next(h), l = next(k);
  const double least = sine * sine;
  if (degree(f) == 3) return is_triangle_above(point(origin(h)), point(origin(k)), point(origin(l)), sine);
  if (degree(f) == 4)
    return is_quad_above(point(origin(h)), point(origin(k)), point(origin(l)), point(target(l)), least);
  for (HalfEdgeId e : sides_of(f))
    if (!is_convex_corner(point(origin(prev(e))), point(origin(e)), point(target(e)), sine)) return false;
  return true;
}

bool Mesh::is_star_above(AnyNode v, double sine) const { return is_star_above(v, sine, sine); }

bool Mesh::is_star_above(AnyNode v, double triangle_sine, double sine) const {
  const double least = sine * sine;
  const Vec2& p = point(v);
  const Index start = out(v);
  Index h = start;
  do {
    const Index f = face(h), to_v = prev(h);
    if (is_quad(f)) {
      const Index k = next(h);
      if (!is_quad_above(p, point(origin(k)), point(origin(next(k))), point(origin(to_v)), least)) return false;
    } else if (f != kNone && !is_above(f, is_triangle(f) ? triangle_sine : sine)) {
      return false;
    }
    h = twin(to_v);
  } while (h != start);
  return true;
}

double Mesh::smallest_sine(AnyFace f) const {
  const Index h = half_edge(f), k = next(h), l = next(k);
  if (degree(f) == 3) return smallest_sine_of(point(origin(h)), point(origin(k)), point(origin(l)));
  if (degree(f) == 4) return smallest_sine_of(point(origin(h)), point(origin(k)), point(origin(l)), point(target(l)));
  double smallest = 1;
  for (Index e = h, i = 0; i < degree(f); ++i, e = next(e))
    smallest = std::min(smallest, corner_sine(point(origin(e)), point(target(e)), point(origin(prev(e)))));
  return smallest;
}

double Mesh::smallest_sine_around(AnyNode v) const {
  double smallest = 1;
  for (HalfEdgeId h : around(v))
    if (face(h) != kNone) smallest = std::min(smallest, smallest_sine(face(h)));
  return smallest;
}

double Mesh::mean_edge(AnyNode v) const {
  double sum = 0;
  int edges = 0;
  for (HalfEdgeId h : around(v)) sum += length(h), ++edges;
  return sum / edges;
}

std::vector<double> Mesh::mean_edges() const {
  std::vector<double> means(vertex_slots(), 0);
  std::vector<Index> edges(vertex_slots(), 0);
  for (Index h = 0; h < half_edge_slots(); h += 2) {
    if (!is_live_half_edge(h)) continue;
    const double edge = length(h);
    for (Index v : {origin(h), target(h)}) means[v] += edge, ++edges[v];
  }
  for (Index v = 0; v < vertex_slots(); ++v)
    if (edges[v] > 0) means[v] /= edges[v];
  return means;
}

}  // namespace qmorph::kernel
