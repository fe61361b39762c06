// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/tips.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "qmorph/quality.hpp"

namespace qmorph::layers {
namespace {

using Quad = std::array<Index, 4>;
using Eigen::Vector3d;

/// Scaled Jacobian, by the quad's own normal.
double smallest_sine(const Patch& patch, const Quad& quad) {
  QuadCorners corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = patch.points[quad[i]];
  return scaled_jacobian(corners, (corners[2] - corners[0]).cross(corners[3] - corners[1]).normalized());
}

/// Quads around nodes that may be those in the middle of a tip.
class Tips {
 public:
  Tips(Patch& patch, std::size_t given, std::size_t first) : patch_(patch) {
    for (std::size_t q = first; q < patch.quads.size(); ++q)
      for (Index v : patch.quads[q]) around_[v];
    for (std::size_t q = 0; q < given; ++q)
      for (Index v : patch.quads[q]) around_.erase(v);
    for (const auto& ends : patch.constraints)
      for (Index v : ends) around_.erase(v);
    for (Index v : patch.fixed) around_.erase(v);
    for (const auto& t : patch.triangles)
      for (Index v : t) around_.erase(v);
    for (const Quad& quad : patch.quads)
      for (Index v : quad)
        if (const auto at = around_.find(v); at != around_.end()) at->second.push_back(quad);
  }

  /// The worst first, while no more quads change than that.
  void widen(std::span<const Quad> tips, std::size_t most_changed) {
    struct Middle {
      double worst;
      Index node, next;
    };
    std::vector<Middle> middles;
    for (const Quad& tip : tips)
      for (std::size_t i = 0; i < 4; ++i)
        if (const auto next = node_after(tip, i)) middles.push_back({worst_around(tip[i]), tip[i], *next});
    std::stable_sort(middles.begin(), middles.end(),
                     [](const Middle& a, const Middle& b) { return a.worst < b.worst; });
    for (const Middle& middle : middles) {
      const std::size_t changed = around_.at(middle.node).size();
      if (changed > most_changed) break;
      if (move(middle.node, middle.next)) most_changed -= changed;
    }
  }

 private:
  /// Of corner i of the quad, if all around are two others, the node at the end of their common side.
  std::optional<Index> node_after(const Quad& quad, std::size_t i) const {
    const auto at = around_.find(quad[i]);
    if (at == around_.end() || at->second.size() != 3) return {};
    std::map<Index, int> neighbours;
    for (const Quad& other : at->second) {
      const std::size_t k = std::size_t(std::find(other.begin(), other.end(), quad[i]) - other.begin());
      ++neighbours[other[(k + 1) % 4]], ++neighbours[other[(k + 3) % 4]];
    }
    if (neighbours.size() != 3) return {};  // on the boundary
    for (const auto& [v, count] : neighbours)
      if (v != quad[(i + 1) % 4] && v != quad[(i + 3) % 4]) return v;
    return {};
  }

  /// False if that makes nothing better.
  bool move(Index node, Index next) {
    constexpr double kGood = 0.7, kStep = 0.02, kFarthest = 0.4;  // shares of the edge
    const Vector3d from = patch_.points[node], edge = patch_.points[next] - from;
    double best = worst_around(node), best_share = 0;
    for (double share = kStep; share <= kFarthest && best < kGood; share += kStep) {
      patch_.points[node] = from + share * edge;
      if (const double worst = worst_around(node); worst > best) best = worst, best_share = share;
    }
    patch_.points[node] = best_share > 0 ? Vector3d(from + best_share * edge) : from;
    return best_share > 0;
  }

  double worst_around(Index node) const {
    double worst = 1;
    for (const Quad& quad : around_.at(node)) worst = std::min(worst, smallest_sine(patch_, quad));
    return worst;
  }

  Patch& patch_;
  std::map<Index, std::vector<Quad>> around_;  ///< by node
};

}  // namespace

void widen_tips(Patch& patch, std::size_t given, std::size_t pairs) {
  constexpr double kMostChanged = 0.01;  // of the layers' quads: else they would not be those of the triangles
  if (pairs == 0) return;
  const std::vector<Quad> tips(patch.quads.end() - std::ptrdiff_t(pairs), patch.quads.end());
  const std::size_t layer_quads = patch.quads.size() - given;
  Tips(patch, given, patch.quads.size() - pairs).widen(tips, std::size_t(kMostChanged * double(layer_quads)));
}

}  // namespace qmorph::layers
