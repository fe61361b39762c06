// SPDX-License-Identifier: GPL-2.0-or-later
#include "quality/size_ratio.hpp"

#include <algorithm>
#include <array>

#include "quality/percentile.hpp"
#include "quality/sides.hpp"

namespace qmorph {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kNeighbours = 12;
/// Ranges of the tree that are this short are looked through one by one: faster than to go further down.
constexpr std::size_t kLeaf = 8;

struct Edge {
  Index low, high;
};

/// Edges by their middles: a balanced k-d tree in an array; the middle of each range is the root of its subtree.
class EdgeTree {
 public:
  EdgeTree(const std::vector<Vector3d>& points, const std::vector<Edge>& edges) {
    for (const Edge& e : edges)
      nodes_.push_back({(points[e.low] + points[e.high]) / 2, (points[e.high] - points[e.low]).norm(), 0});
    build(0, nodes_.size());
  }

  /// Median length of the edges nearest to p.
  double local_length(const Vector3d& p) {
    found_count_ = 0;
    search(0, nodes_.size(), p);
    lengths_.clear();
    for (std::size_t i = 0; i < found_count_; ++i) lengths_.push_back(found_[i].length);
    return percentile(lengths_, 50);
  }

 private:
  struct Node {
    Vector3d middle;
    double length;
    int axis;
  };

  void build(std::size_t first, std::size_t last) {
    if (last - first <= kLeaf) return;
    Vector3d low = nodes_[first].middle, high = low;
    for (std::size_t i = first; i < last; ++i)
      low = low.cwiseMin(nodes_[i].middle), high = high.cwiseMax(nodes_[i].middle);
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const std::size_t root = (first + last) / 2;
    const auto at = [&](std::size_t i) { return nodes_.begin() + std::ptrdiff_t(i); };
    std::nth_element(at(first), at(root), at(last),
                     [axis](const Node& a, const Node& b) { return a.middle[axis] < b.middle[axis]; });
    nodes_[root].axis = axis;
    build(first, root);
    build(root + 1, last);
  }

  void search(std::size_t first, std::size_t last, const Vector3d& p) {
    if (last - first <= kLeaf) {
      for (std::size_t i = first; i < last; ++i) consider(nodes_[i], p);
      return;
    }
    const std::size_t root = (first + last) / 2;
    const Node& node = nodes_[root];
    consider(node, p);
    const double beyond = p[node.axis] - node.middle[node.axis];
    const bool left = beyond < 0;
    left ? search(first, root, p) : search(root + 1, last, p);
    if (found_count_ < kNeighbours || beyond * beyond <= found_[kNeighbours - 1].distance)
      left ? search(root + 1, last, p) : search(first, root, p);
  }

  /// Keeps the nearest in order.
  void consider(const Node& node, const Vector3d& p) {
    const double distance = (node.middle - p).squaredNorm();
    if (found_count_ == kNeighbours && distance >= found_[kNeighbours - 1].distance) return;
    std::size_t at = found_count_ < kNeighbours ? found_count_++ : kNeighbours - 1;
    for (; at > 0 && distance < found_[at - 1].distance; --at) found_[at] = found_[at - 1];
    found_[at] = {distance, node.length};
  }

  std::vector<Node> nodes_;
  struct Found {
    double distance, length;
  };
  std::array<Found, kNeighbours> found_;
  std::size_t found_count_ = 0;
  std::vector<double> lengths_;
};

}  // namespace

std::vector<double> size_ratios(const Patch& before, const QuadMesh& after) {
  std::vector<Edge> edges;
  for_each_edge(sorted_sides(before.points.size(), before.triangles, before.quads), [&](std::span<const Side> sides) {
    edges.push_back({sides[0].low, sides[0].high});
  });
  std::vector<double> ratios;
  if (edges.empty()) return ratios;
  EdgeTree tree(before.points, edges);
  for_each_edge(sorted_sides(after.points.size(), after.triangles, after.quads), [&](std::span<const Side> sides) {
    if (sides.size() < 2) return;
    const Vector3d &a = after.points[sides[0].low], &b = after.points[sides[0].high];
    const double nearby = tree.local_length((a + b) / 2);
    if (nearby > 0) ratios.push_back((b - a).norm() / nearby);
  });
  return ratios;
}

}  // namespace qmorph
