// SPDX-License-Identifier: GPL-2.0-or-later
#include "smoothing/corner_energy.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/predicates.hpp"
#include "smoothing/node_energy.hpp"

namespace qmorph::smoothing {
namespace {

using kernel::Mesh;

constexpr int kPower = 6;
/// Sines do not see lengths: corners whose edges differ a lot cost as if they were sharper.
constexpr double kLengthWeight = 0.1;
/// The sum of the squared ratios, one way and the other, counts up to this, about five to one: beside an edge of the
/// boundary that is far shorter corners would cost so much for what no node can change that sharp ones stayed.
constexpr double kMostLengthRatio = 25;

/// A corner with the edges a and b. Its energy is f^kPower with
///   f = |a|^2 |b|^2 / J^2 = 1 / sine^2, for the area J = a x b,
/// and a small part of the squared ratio of the edges' lengths. Derivatives are with respect to the node.
struct CornerTerm {
  Vec2 a, b;
  double da, db;  ///< how the edges follow the node: -1, 0 or 1
};

/// Adds the gradient of f^kPower and its second derivatives, for its value. With log f = log aa + log bb - 2 log J for
/// aa = |a|^2, bb = |b|^2:
///   grad f^p  = p f^p grad log f
///   grad2 f^p = p f^p (grad2 log f + p grad log f grad log f^T)
/// The part of the lengths' ratio is small and left out.
void add_derivatives(Energy& energy, const CornerTerm& c, double value) {
  const double j = cross(c.a, c.b), aa = c.a.squaredNorm(), bb = c.b.squaredNorm();
  const Vec2 of_a = (2 * c.da / aa) * c.a, of_b = (2 * c.db / bb) * c.b;  // gradients of log aa, log bb
  const Vec2 of_j = Vec2(c.da * c.b.y() - c.db * c.a.y(), c.db * c.a.x() - c.da * c.b.x()) / j;  // of log J
  const Vec2 of_f = of_a + of_b - 2 * of_j;
  const double diagonal = 2 * c.da * c.da / aa + 2 * c.db * c.db / bb;
  const auto second = [&](int m, int n) {
    return (m == n ? diagonal : 0) - of_a[m] * of_a[n] - of_b[m] * of_b[n] + 2 * of_j[m] * of_j[n] +
           kPower * of_f[m] * of_f[n];
  };
  const double weight = kPower * value;
  energy.gradient += weight * of_f;
  energy.xx += weight * second(0, 0);
  energy.yy += weight * second(1, 1);
  energy.xy += weight * second(0, 1);
}

/// Adds the term to the energy; with derivatives if `derive`. False if the corner is straight or worse.
bool add(Energy& energy, const CornerTerm& c, bool derive) {
  const double j = cross(c.a, c.b), aa = c.a.squaredNorm(), bb = c.b.squaredNorm();
  if (!(j * j > kStraightSine * kStraightSine * aa * bb) || j <= 0) {
    energy.finite = false;
    return false;
  }
  const double ratio = std::min(aa / bb + bb / aa, kMostLengthRatio);
  const double f = aa * bb / (j * j) * (1 - kLengthWeight + kLengthWeight * 0.5 * ratio);
  const double cube = f * f * f, value = cube * cube;  // f^kPower; std::pow rounds in a way of its own on each machine
  energy.value += value;
  if (derive) add_derivatives(energy, c, value);
  return true;
}

/// The corners of an element that follow the node. False if one of them is not good.
bool add(Energy& energy, const StarElement& e, const Vec2& p, bool derive) {
  return add(energy, {e.q - p, e.r - p, -1, -1}, derive) && add(energy, {e.after_q - e.q, p - e.q, 0, 1}, derive) &&
         add(energy, {p - e.r, e.before_r - e.r, 1, 0}, derive);
}

/// Of all corners of the elements around v, as if v were at p.
Energy corners_around(const Mesh& mesh, Index v, const Vec2& p, bool derive) {
  Energy energy;
  for (Index h : mesh.around(v)) {
    if (mesh.face(h) != kNone) {
      const Vec2 &q = mesh.point(mesh.target(h)), &r = mesh.point(mesh.origin(mesh.prev(h)));
      const Vec2 &after_q = mesh.point(mesh.target(mesh.next(h))),
                 &before_r = mesh.point(mesh.origin(mesh.prev(mesh.prev(h))));
      if (!add(energy, {q, after_q, before_r, r}, p, derive)) return energy;
    }
  }
  return energy;
}

/// Returns how far the node moved, in edge lengths.
double improve(Mesh& mesh, Index v, double good) {
  constexpr std::size_t kWorkOfDerivatives = 6, kWorkOfValue = 3;  // for each element
  const Vec2 start = mesh.point(v);
  const std::size_t elements = mesh.valence(v);
  mesh.add_work(kWorkOfDerivatives * elements);
  const Energy energy = corners_around(mesh, v, start, true);
  if (!energy.finite) return 0;
  const double edge = mesh.mean_edge(v), worst = std::min(good, mesh.smallest_sine_around(v));
  const double determinant = energy.xx * energy.yy - energy.xy * energy.xy;
  const Vec2& g = energy.gradient;
  Vec2 step = Vec2::Zero();
  if (energy.xx > 0 && determinant > 0)
    step = Vec2(energy.xy * g.y() - energy.yy * g.x(), energy.xy * g.x() - energy.xx * g.y()) / determinant;
  else if (g.norm() > 0)
    step = -0.1 * edge / g.norm() * g;
  for (double share = 1; share > 0.05; share /= 2) {
    const Vec2 p = start + share * step;
    mesh.add_work(kWorkOfValue * elements);
    const Energy there = corners_around(mesh, v, p, false);
    if (!there.finite || !(there.value < energy.value)) continue;
    mesh.set_point(v, p);
    if (mesh.smallest_sine_around(v) >= worst) return share * step.norm() / edge;
    mesh.set_point(v, start);
  }
  return 0;
}

/// A face and its smallest sine.
struct FaceSine {
  Index face;
  double sine;
};

/// The sine below which elements count as bad: at most a small share of them, since what they gain the others lose.
double bad_sine(const Mesh& mesh, const std::vector<FaceSine>& below_good, double good) {
  constexpr double kMostBad = 0.05;
  std::size_t faces = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f) faces += mesh.is_live_face(f);
  const auto most = std::size_t(std::ceil(kMostBad * double(faces)));
  if (below_good.size() <= most) return good;
  std::vector<double> sines;
  for (const FaceSine& face : below_good) sines.push_back(face.sine);
  std::nth_element(sines.begin(), sines.begin() + most, sines.end());
  return sines[most];
}

/// Free nodes of the bad faces and of `rings` rings of faces around.
std::vector<Index> nodes_near_bad(const Mesh& mesh, double good, int rings) {
  std::vector<FaceSine> faces;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (mesh.is_live_face(f) && !mesh.is_above(f, good)) faces.push_back({f, mesh.smallest_sine(f)});
  }
  const double bad = bad_sine(mesh, faces, good);
  std::vector<Index> nodes;
  std::vector<char> taken(mesh.vertex_slots(), 0);
  const auto take = [&](Index f) {
    Index h = mesh.half_edge(f);
    for (Index i = 0; i < mesh.degree(f); ++i, h = mesh.next(h))
      if (!taken[mesh.origin(h)]) taken[mesh.origin(h)] = 1, nodes.push_back(mesh.origin(h));
  };
  for (const FaceSine& face : faces)
    if (face.sine < bad) take(face.face);
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t count = nodes.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (Index h : mesh.around(nodes[i]))
        if (mesh.face(h) != kNone) take(mesh.face(h));
    }
  }
  std::erase_if(nodes, [&](Index v) { return !mesh.is_free(v); });
  return nodes;
}

}  // namespace

Energy corner_energy(std::span<const StarElement> elements, const Vec2& p, bool derive) {
  Energy energy;
  for (const StarElement& e : elements)
    if (!add(energy, e, p, derive)) break;
  return energy;
}

void raise_worst_corners(Mesh& mesh, const SmoothingOptions& options, const kernel::Budget& budget) {
  constexpr int kRings = 1, kPasses = 8, kFewest = 2;
  const std::vector<Index> nodes = nodes_near_bad(mesh, options.good_quality, kRings);
  for (int pass = 0; pass < kPasses && (pass < kFewest || !budget.is_spent()); ++pass) {
    double moved = 0;
    for (Index v : nodes) moved = std::max(moved, improve(mesh, v, options.good_quality));
    if (moved < options.move_tolerance) break;
  }
}

}  // namespace qmorph::smoothing
