// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/pair_up.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "chart/rework.hpp"
#include "chart/topology.hpp"
#include "elimination/eliminate.hpp"
#include "engine/pipeline.hpp"
#include "geometry/predicates.hpp"
#include "space/corners.hpp"

namespace qmorph::chart {
namespace {

bool is_triangle(const Face& face) { return degree(face) == 3; }

/// The sides of a triangle after the one that it shares, and those of its neighbour, in the order of the quad that both
/// make.
std::array<Index, 4> sides_of_pair(Index side, Index other) {
  const auto after = [](Index s, Index by) { return s - s % 4 + (s % 4 + by) % 3; };
  return {after(other, 1), after(other, 2), after(side, 1), after(side, 2)};
}

struct Pair {
  double sine;
  Index side, other;
};

double sine_of(const SurfaceMesh& mesh, const std::array<Index, 4>& sides, const space::Background& background) {
  space::Corners<4> p;
  for (int i = 0; i < 4; ++i) p[i] = mesh.points[mesh.faces[sides[i] / 4][sides[i] % 4]];
  // Corners 0 and 2 belong to both triangles.
  const Eigen::Vector3d second = background.normal_near(mesh.near[sides[0] / 4]),
                        first = background.normal_near(mesh.near[sides[2] / 4]), both = first + second;
  return space::scaled_jacobian<4>(p, {{both, second, both, first}, both});
}

bool has_four_corners(const SurfaceMesh& mesh, const std::array<Index, 4>& sides) {
  const auto corner = [&](int i) { return mesh.node[mesh.faces[sides[i] / 4][sides[i] % 4]]; };
  return corner(0) != corner(2) && corner(1) != corner(3);
}

std::vector<Pair> pairs_of(const SurfaceMesh& mesh, const std::vector<Index>& opposite,
                           const std::vector<bool>& is_wall, const space::Background& background) {
  std::vector<Pair> pairs;
  for (Index side = 0; side < opposite.size(); ++side) {
    const Index other = opposite[side];
    if (other == kNone || other < side || is_wall[side]) continue;
    if (!is_triangle(mesh.faces[side / 4]) || !is_triangle(mesh.faces[other / 4])) continue;
    const auto sides = sides_of_pair(side, other);
    if (!has_four_corners(mesh, sides)) continue;
    if (const double sine = sine_of(mesh, sides, background); sine > kStraightSine)
      pairs.push_back({sine, side, other});
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.sine > b.sine; });
  return pairs;
}

/// Of each two triangles that make a good quad one becomes the quad, and the other goes.
void join_pairs(SurfaceMesh& mesh, const std::vector<bool>& is_wall, const space::Background& background) {
  std::vector<char> gone(mesh.faces.size(), 0);
  for (const Pair& pair : pairs_of(mesh, opposite_sides(mesh), is_wall, background)) {
    const Index f = pair.side / 4, g = pair.other / 4;
    if (gone[f] || gone[g] || !is_triangle(mesh.faces[f]) || !is_triangle(mesh.faces[g])) continue;
    Face quad{};
    std::array<bool, 4> open{};
    const auto sides = sides_of_pair(pair.side, pair.other);
    for (int i = 0; i < 4; ++i) quad[i] = mesh.faces[sides[i] / 4][sides[i] % 4], open[i] = mesh.open[sides[i]];
    mesh.faces[f] = quad;
    for (Index i = 0; i < 4; ++i) mesh.open[4 * f + i] = open[i];
    gone[g] = 1;
  }
  Index kept = 0;
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    if (gone[f]) continue;
    mesh.faces[kept] = mesh.faces[f], mesh.near[kept] = mesh.near[f];
    for (Index i = 0; i < 4; ++i) mesh.open[4 * kept + i] = mesh.open[4 * f + i];
    ++kept;
  }
  mesh.faces.resize(kept), mesh.near.resize(kept), mesh.open.resize(4 * std::size_t(kept));
}

constexpr std::size_t kWorkOfLook = 2;

/// Finds chains of faces from triangle to triangle that have no face in common, and what they become.
class Chains {
 public:
  Chains(const SurfaceMesh& mesh, const std::vector<bool>& is_wall, const space::Background& background,
         const SmoothingOptions& smoothing)
      : mesh_(mesh),
        opposite_(opposite_sides(mesh)),
        is_wall_(is_wall),
        background_(background),
        smoothing_(smoothing),
        is_taken_(mesh.faces.size(), 0),
        came_from_(mesh.faces.size(), kNone) {}

  /// `longest`: faces that a search looks at. `looks` are left for all.
  std::vector<Reworked> run(std::size_t longest, std::size_t& looks) {
    std::vector<Reworked> results;
    looks_ = looks;
    for (Index f = 0; f < mesh_.faces.size() && looks_ > 0; ++f) {
      if (!is_triangle(mesh_.faces[f]) || is_taken_[f]) continue;
      const std::vector<Index> chain = chain_from(f, longest);
      if (chain.empty()) continue;
      std::optional<Reworked> done = join(with_ring(chain));
      if (!done) done = join(chain);
      if (done) results.push_back(std::move(*done));
    }
    looks = looks_;
    return results;
  }

 private:
  template <class Visit>
  void for_neighbours(Index f, const Visit& visit) const {
    for (Index side = 4 * f; side < 4 * f + degree(mesh_.faces[f]); ++side)
      if (opposite_[side] != kNone && !is_wall_[side] && !is_taken_[opposite_[side] / 4]) visit(opposite_[side] / 4);
  }

  /// The shortest; empty if there is none within reach.
  std::vector<Index> chain_from(Index start, std::size_t longest) {
    std::vector<Index> reached{start}, chain;
    came_from_[start] = start;
    for (std::size_t k = 0; k < reached.size() && k < longest && chain.empty(); ++k) {
      const Index f = reached[k];
      for_neighbours(f, [&](Index g) {
        if (came_from_[g] != kNone || !chain.empty()) return;
        came_from_[g] = f;
        reached.push_back(g);
        if (!is_triangle(mesh_.faces[g])) return;
        for (Index on = g; on != start; on = came_from_[on]) chain.push_back(on);
        chain.push_back(start);
      });
    }
    for (Index f : reached) came_from_[f] = kNone;
    spend(reached.size());
    return chain;
  }

  void spend(std::size_t looks) { looks_ -= std::min(looks_, looks); }

  /// Quads around the chain make room for it.
  std::vector<Index> with_ring(std::vector<Index> faces) const {
    std::vector<Index> ring;
    for (Index f : faces)
      for_neighbours(f, [&](Index g) {
        if (!is_triangle(mesh_.faces[g])) ring.push_back(g);
      });
    std::sort(faces.begin(), faces.end());
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    std::vector<Index> all;
    std::set_union(faces.begin(), faces.end(), ring.begin(), ring.end(), std::back_inserter(all));
    return all;
  }

  std::optional<Reworked> join(const std::vector<Index>& faces) {
    constexpr double kMostDistortion = 1.5;
    constexpr std::size_t kLooksToJoin = 300;  // of a face
    spend(kLooksToJoin * faces.size());
    auto laid_out = std::make_unique<LaidOut>(mesh_, opposite_, is_wall_, faces);
    const auto& [piece, chart] = *laid_out;
    if (!is_planar_topology(piece) || chart.flattening().flipped > 0 || chart.flattening().distortion > kMostDistortion)
      return {};
    Reworked work{&piece, piece.mesh(chart.flat()), {}};
    const std::size_t left = elimination::eliminate_triangles(work.mesh, smoothing_);
    spend(work.mesh.work() / kWorkOfLook);
    if (left > 0) return {};
    for (Index f = 0; f < work.mesh.face_slots(); ++f)
      if (work.mesh.is_live_face(f) && !work.mesh.is_valid_face(f)) return {};
    if (folds_onto_itself(work.mesh, piece)) return {};
    work.lifted = lift(work.mesh, piece, chart, background_);
    for (Index f : faces) is_taken_[f] = 1;
    laid_out_.push_back(std::move(laid_out));
    return work;
  }

  const SurfaceMesh& mesh_;
  const std::vector<Index> opposite_;
  const std::vector<bool>& is_wall_;
  const space::Background& background_;
  const SmoothingOptions& smoothing_;
  std::size_t looks_ = 0;       ///< at faces that are left
  std::vector<char> is_taken_;  ///< by face
  std::vector<Index> came_from_;
  std::vector<std::unique_ptr<LaidOut>> laid_out_;  ///< of the results
};

}  // namespace

std::size_t pair_up(SurfaceMesh& mesh, const std::vector<Edge>& walls, const space::Background& background,
                    const SmoothingOptions& smoothing) {
  join_pairs(mesh, sides_on(mesh, walls), background);
  constexpr std::size_t kNear = 100, kFarther = 8;
  // Each search is short as long as others find what they look for. Where nothing can be joined it is not.
  constexpr std::size_t kLooksEach = 1000, kFewLooks = 100'000;
  std::size_t longest = kNear, looks = kFewLooks + kLooksEach * mesh.faces.size();
  const std::size_t all_looks = looks;
  while (looks > 0) {
    const std::vector<bool> is_wall = sides_on(mesh, walls);
    Chains chains(mesh, is_wall, background, smoothing);
    std::vector<Reworked> results = chains.run(longest, looks);
    looks -= std::min(looks, mesh.faces.size());
    if (!results.empty()) {
      mesh = replace_where_simple(mesh, std::move(results));
      continue;
    }
    if (longest > mesh.faces.size()) break;
    longest *= kFarther;
  }
  return kWorkOfLook * (all_looks - looks);
}

}  // namespace qmorph::chart
