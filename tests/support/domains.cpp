// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/domains.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "support/cutouts.hpp"
#include "support/outlines.hpp"
#include "support/spoil.hpp"

namespace qmorph::test {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostTriangles = 2500;
/// No triangle of an input is flatter than this: a height of a hundredth of the longest side, in one domain of eight a
/// thousandth.
constexpr double kFlattest = 0.01, kFlattestOfAll = 0.001;

/// Draws until there is something that can be used.
Draft usable_draft(Rng& rng, std::string& kind, double flattest) {
  while (true) {
    const double choice = rng.uniform();
    std::optional<Draft> draft = choice < 0.6   ? drawn_domain(rng, kind)
                                 : choice < 0.9 ? cut_out_domain(rng, kind)
                                                : tiny_domain(rng, kind);
    if (draft && draft->triangles.size() <= kMostTriangles && worst_flatness(*draft) >= flattest) return *draft;
  }
}

void spoil(Draft& draft, Rng& rng, std::string& kind, double flattest) {
  const auto maybe = [&](double probability, const char* name) {
    const bool yes = rng.chance(probability);
    if (yes) kind += name;
    return yes;
  };
  if (maybe(0.25, " flips"))
    for (int pass = rng.range(1, 3); pass > 0; --pass) flip_edges(draft, rng, rng.between(0.02, 0.5), flattest);
  if (maybe(0.4, " jitter")) jitter_nodes(draft, rng, rng.between(0.1, 1.2), flattest);
  if (maybe(0.2, " walks")) add_constraint_walks(draft, rng, rng.range(1, 8));
  if (maybe(0.1, " loop")) add_constraint_loop(draft, rng);
  if (maybe(0.1, " borders")) add_material_borders(draft, rng, rng.range(1, 3));
  if (maybe(0.2, " points")) fix_nodes(draft, rng, rng.range(1, rng.chance(0.2) ? 50 : 5));
  if (maybe(0.15, " quads")) make_quads(draft, rng);
  if (draft.quads.empty() && rng.chance(0.5)) add_boundary_constraints(draft);
}

Patch to_patch(const Draft& draft) {
  Patch patch;
  for (const Eigen::Vector2d& p : draft.points) patch.points.emplace_back(p.x(), p.y(), 0);
  patch.triangles = draft.triangles;
  patch.quads = draft.quads;
  patch.constraints = draft.constraints;
  patch.fixed = draft.fixed;
  return patch;
}

/// Somewhere in space, at some scale. A shift is at most ten times the size: more would be noise in the coordinates.
Patch posed(Patch patch, Rng& rng, std::string& kind) {
  const double scale = rng.chance(0.5) ? 1 : rng.power_of_two(-20, 20);
  const Vector3d shift = scale * Vector3d(rng.between(-10, 10), rng.between(-10, 10), rng.between(-10, 10));
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  switch (rng.below(4)) {
    case 0:
      patch = moved(std::move(patch), scale, turn, Vector3d::Zero());
      break;
    case 1:  // one of the planes of the axes
      turn << 0, 0, 1, 1, 0, 0, 0, 1, 0;
      if (rng.chance(0.5)) turn = Eigen::Matrix3d(turn * turn);
      patch = moved(std::move(patch), scale, turn, Vector3d::Zero());
      kind += " upright";
      break;
    default:
      patch = moved(std::move(patch), scale, random_rotation(rng), rng.chance(0.5) ? shift : Vector3d::Zero());
      kind += " tilted";
  }
  if (rng.chance(0.25)) {
    patch = turned_over(std::move(patch));
    kind += " clockwise";
  }
  if (rng.chance(0.5)) patch = renumbered(patch, rng);
  return patch;
}

template <std::size_t N>
void start_anywhere(std::array<Index, N>& nodes, Rng& rng) {
  std::rotate(nodes.begin(), nodes.begin() + std::ptrdiff_t(rng.below(N)), nodes.end());
}

}  // namespace

Domain random_domain(std::uint64_t seed) {
  Rng rng(seed);
  Domain domain;
  const double flattest = rng.chance(0.125) ? kFlattestOfAll : kFlattest;
  Draft draft = usable_draft(rng, domain.kind, flattest);
  spoil(draft, rng, domain.kind, flattest);
  domain.patch = posed(to_patch(draft), rng, domain.kind);
  return domain;
}

Patch moved(Patch patch, double scale, const Eigen::Matrix3d& turn, const Vector3d& shift) {
  for (Vector3d& p : patch.points) p = scale * (turn * p) + shift;
  return patch;
}

Patch renumbered(const Patch& patch, Rng& rng) {
  std::vector<Index> order(patch.points.size());
  for (Index i = 0; i < order.size(); ++i) order[i] = i;
  rng.shuffle(order);
  Patch result = patch;
  for (std::size_t i = 0; i < order.size(); ++i) result.points[order[i]] = patch.points[i];
  const auto renumber = [&](auto& elements) {
    for (auto& nodes : elements) {
      for (Index& i : nodes) i = order[i];
      start_anywhere(nodes, rng);
    }
    rng.shuffle(elements);
  };
  renumber(result.triangles);
  renumber(result.quads);
  renumber(result.constraints);
  for (Index& i : result.fixed) i = order[i];
  rng.shuffle(result.fixed);
  return result;
}

Patch turned_over(Patch patch) {
  for (auto& t : patch.triangles) std::swap(t[1], t[2]);
  for (auto& q : patch.quads) std::swap(q[1], q[3]);
  return patch;
}

Eigen::Matrix3d random_rotation(Rng& rng) {
  Eigen::Vector4d q;
  do {
    for (int i = 0; i < 4; ++i) q[i] = rng.between(-1, 1);
  } while (q.norm() > 1 || q.norm() < 0.1);
  q.normalize();
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

}  // namespace qmorph::test
