// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/coarse.hpp"

#include <algorithm>

#include "chart/flatten.hpp"
#include "chart/topology.hpp"
#include "kernel/sort_unique.hpp"

namespace qmorph::chart {
namespace {

/// Edges between two points that are kept.
constexpr int kStep = 4;
/// Fewer triangles say too little.
constexpr std::size_t kFewTriangles = 60;

using Triangle = space::Background::Triangle;

/// Points of a piece by point, each edge from both ends.
class Neighbours {
 public:
  explicit Neighbours(const Piece& piece) : first_(piece.points.size() + 1, 0), list_(6 * piece.halves.size()) {
    for (const Triangle& t : piece.halves)
      for (Index v : t) first_[v] += 2;
    Index sum = 0;
    for (Index& at : first_) sum += at, at = sum;
    for (const Triangle& t : piece.halves)
      for (int i = 0; i < 3; ++i) {
        list_[--first_[t[i]]] = t[(i + 1) % 3];
        list_[--first_[t[i]]] = t[(i + 2) % 3];
      }
  }
  std::span<const Index> of(Index v) const { return {list_.data() + first_[v], list_.data() + first_[v + 1]}; }

 private:
  std::vector<Index> first_, list_;
};

class Thinning {
 public:
  explicit Thinning(const Piece& piece) : piece_(piece), neighbours_(piece), covered_(piece.points.size(), 0) {}

  /// By point: the number of the kept one that is fewest edges away.
  std::vector<Index> run() {
    for (const std::vector<Index>& loop : loops_of(piece_))
      for (std::size_t k = 0; k < loop.size(); k += kStep) keep(loop[k]);
    for (Index v = 0; v < piece_.points.size(); ++v)
      if (!covered_[v]) keep(v);
    std::vector<Index> nearest(piece_.points.size(), kNone), order = kept_;
    for (Index k = 0; k < kept_.size(); ++k) nearest[kept_[k]] = k;
    for (std::size_t k = 0; k < order.size(); ++k)
      for (Index w : neighbours_.of(order[k]))
        if (nearest[w] == kNone) nearest[w] = nearest[order[k]], order.push_back(w);
    return nearest;
  }

  const std::vector<Index>& kept() const { return kept_; }

 private:
  void keep(Index v) {
    kept_.push_back(v);
    covered_[v] = kStep;
    std::vector<Index> ring{v}, next;
    for (char left = kStep - 1; left > 0; --left, std::swap(ring, next)) {
      next.clear();
      for (Index a : ring)
        for (Index b : neighbours_.of(a))
          if (covered_[b] < left) covered_[b] = left, next.push_back(b);
    }
  }

  const Piece& piece_;
  const Neighbours neighbours_;
  std::vector<char> covered_;  ///< by point: how many edges farther a kept one near it reaches, and 1
  std::vector<Index> kept_;
};

}  // namespace

std::optional<double> coarse_distortion(const Piece& piece) {
  Thinning thinning(piece);
  const std::vector<Index> nearest = thinning.run();
  std::vector<Triangle> triangles;
  for (const Triangle& t : piece.halves) {
    Triangle coarse{nearest[t[0]], nearest[t[1]], nearest[t[2]]};
    if (coarse[0] == coarse[1] || coarse[1] == coarse[2] || coarse[2] == coarse[0]) continue;
    std::rotate(coarse.begin(), std::min_element(coarse.begin(), coarse.end()), coarse.end());
    triangles.push_back(coarse);
  }
  sort_unique(triangles);
  if (triangles.size() < kFewTriangles) return {};
  std::vector<Index> number(thinning.kept().size(), kNone);
  std::vector<Eigen::Vector3d> points;
  for (Triangle& t : triangles)
    for (Index& v : t) {
      if (number[v] == kNone) number[v] = Index(points.size()), points.push_back(piece.points[thinning.kept()[v]]);
      v = number[v];
    }
  const Flattening flat = flatten(space::Background(points, triangles), points.size());
  if (flat.flipped > 0) return {};
  return flat.distortion;
}

}  // namespace qmorph::chart
