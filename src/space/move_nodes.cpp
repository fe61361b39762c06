// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/move_nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace qmorph::space {
namespace {

using Eigen::Vector3d;

/// Above this an element may get worse.
constexpr double kLeastQuality = 0.3;
/// Of what an element had: less than that is clearly worse.
constexpr double kSameQuality = 0.95;

class Mover {
 public:
  Mover(const Result& result, std::span<const Move> moves, QuadMesh& mesh)
      : result_(result), mesh_(mesh), home_(mesh.points), is_away_(mesh.points.size(), 0) {
    for (const Move& move : moves) mesh.points[move.node] = move.to, is_away_[move.node] = 1;
  }

  /// Each round sends nodes home, after which others may not fit any more.
  std::vector<Index> run(std::span<const Move> moves) {
    constexpr int kMostRounds = 20;
    for (int round = 0; send_home(round + 1 == kMostRounds); ++round) {
    }
    std::vector<Index> stayed;
    for (const Move& move : moves)
      if (!is_away_[move.node]) stayed.push_back(move.node);
    std::sort(stayed.begin(), stayed.end());
    return stayed;
  }

 private:
  /// The nodes of spoiled elements, or of all. True if there are any.
  bool send_home(bool all) {
    std::vector<Index> home;
    const auto visit = [&](Index element, const auto& nodes) {
      const bool moved = std::any_of(nodes.begin(), nodes.end(), [&](Index v) { return is_away_[v]; });
      if (!moved || (!all && !is_spoiled(element, nodes))) return;
      for (Index v : nodes)
        if (is_away_[v]) home.push_back(v);
    };
    Index element = 0;
    for (const auto& triangle : mesh_.triangles) visit(element++, triangle);
    for (const auto& quad : mesh_.quads) visit(element++, quad);
    for (Index v : home) mesh_.points[v] = home_[v], is_away_[v] = 0;
    return !home.empty() && !all;
  }

  template <std::size_t N>
  bool is_spoiled(Index element, const std::array<Index, N>& nodes) const {
    const Corners<N> corners = corners_at(mesh_.points, nodes);
    const double sine = least_sine(element, corners, nodes), quality = std::min(sine, own_sine(corners));
    if (quality > kLeastQuality) return false;
    if (!(sine > 0)) return true;
    const Corners<N> before = corners_at(home_, nodes);
    const double had = std::min(least_sine(element, before, nodes), own_sine(before));
    return quality < had - (1 - kSameQuality) * std::abs(had);
  }

  template <std::size_t N>
  static Corners<N> corners_at(const std::vector<Vector3d>& points, const std::array<Index, N>& nodes) {
    Corners<N> corners;
    for (std::size_t i = 0; i < N; ++i) corners[i] = points[nodes[i]];
    return corners;
  }

  template <std::size_t N>
  double least_sine(Index element, const Corners<N>& corners, const std::array<Index, N>& nodes) const {
    const auto sines = result_.sines(element, corners, nodes);
    return *std::min_element(sines.begin(), sines.end());
  }

  const Result& result_;
  QuadMesh& mesh_;
  const std::vector<Vector3d> home_;
  std::vector<char> is_away_;
};

}  // namespace

std::vector<Index> movable_nodes(const Result& result, const Patch& before) {
  const QuadMesh& mesh = result.mesh();
  std::vector<char> is_fixed(before.points.size(), 0);
  for (Index row : before.fixed) is_fixed[row] = 1;
  for (const auto& [a, b] : before.constraints) is_fixed[a] = is_fixed[b] = 1;
  std::vector<Index> nodes;
  for (Index v = 0; v < mesh.points.size(); ++v) {
    const Index row = mesh.source[v];
    const bool at_rest = row != kNone && (is_fixed[row] || mesh.points[v] == before.points[row]);
    if (!at_rest && result.foot(v).triangle != kNone) nodes.push_back(v);
  }
  return nodes;
}

std::vector<Index> move_nodes(const Result& result, std::span<const Move> moves, QuadMesh& mesh) {
  return Mover(result, moves, mesh).run(moves);
}

}  // namespace qmorph::space
