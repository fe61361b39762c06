// SPDX-License-Identifier: GPL-2.0-or-later
#include "quality/locate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>

namespace qmorph {
namespace {

using Eigen::Vector3d;

/// By how much of its longest side a quad reaches beyond itself. The middle of a quad of a curved surface lies beside
/// it.
constexpr double kReach = 0.1;
/// Ranges of the tree that are this short are looked through one by one.
constexpr std::size_t kLeaf = 2;

/// Places in a balanced k-d tree in an array; the middle of each range is the root of its subtree.
class Places {
 public:
  explicit Places(const std::vector<Vector3d>& places) : order_(places.size()), axis_(places.size(), 0) {
    std::iota(order_.begin(), order_.end(), Index(0));
    build(places, 0, order_.size());
    for (Index i : order_) sorted_.push_back(places[i]);
  }

  /// Calls visit(number, place) for each in the box.
  template <class Visit>
  void for_each_in(const Vector3d& low, const Vector3d& high, const Visit& visit) const {
    search(0, order_.size(), low, high, visit);
  }

 private:
  void build(const std::vector<Vector3d>& places, std::size_t first, std::size_t last) {
    if (last - first <= kLeaf) return;
    Vector3d low = places[order_[first]], high = low;
    for (std::size_t i = first; i < last; ++i)
      low = low.cwiseMin(places[order_[i]]), high = high.cwiseMax(places[order_[i]]);
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    const std::size_t root = (first + last) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + std::ptrdiff_t(i); };
    std::nth_element(at(first), at(root), at(last),
                     [&](Index a, Index b) { return places[a][axis] < places[b][axis]; });
    axis_[root] = int(axis);
    build(places, first, root);
    build(places, root + 1, last);
  }

  template <class Visit>
  void search(std::size_t first, std::size_t last, const Vector3d& low, const Vector3d& high,
              const Visit& visit) const {
    const auto look = [&](std::size_t i) {
      if ((sorted_[i].array() >= low.array()).all() && (sorted_[i].array() <= high.array()).all())
        visit(order_[i], sorted_[i]);
    };
    while (last - first > kLeaf) {
      const std::size_t root = (first + last) / 2;
      const int axis = axis_[root];
      if (high[axis] < sorted_[root][axis]) {
        last = root;
      } else if (low[axis] > sorted_[root][axis]) {
        first = root + 1;
      } else {
        look(root);
        search(first, root, low, high, visit);
        first = root + 1;
      }
    }
    for (std::size_t i = first; i < last; ++i) look(i);
  }

  std::vector<Index> order_;
  std::vector<int> axis_;
  std::vector<Vector3d> sorted_;
};

/// How far p is outside a triangle, as a share of its longest side.
double distance(const Vector3d& p, const std::array<Vector3d, 3>& corners, double longest) {
  const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double size = normal.norm();
  if (!(size > 0)) return std::numeric_limits<double>::infinity();
  double outside = std::abs((p - corners[0]).dot(normal)) / size;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d side = corners[(i + 1) % 3] - corners[i];
    outside = std::max(outside, -side.cross(p - corners[i]).dot(normal) / (size * side.norm()));
  }
  return outside / longest;
}

}  // namespace

std::vector<Index> locate(const std::vector<Vector3d>& places, const std::vector<Vector3d>& points,
                          std::span<const std::array<Index, 4>> quads) {
  const Places tree(places);
  std::vector<Index> found(places.size(), kNone);
  std::vector<double> best(places.size(), kReach);
  for (Index q = 0; q < quads.size(); ++q) {
    const Vector3d &a = points[quads[q][0]], &b = points[quads[q][1]], &c = points[quads[q][2]],
                   &d = points[quads[q][3]];
    Vector3d low = a.cwiseMin(b).cwiseMin(c.cwiseMin(d)), high = a.cwiseMax(b).cwiseMax(c.cwiseMax(d));
    const double longest = (high - low).maxCoeff();
    low.array() -= kReach * longest;
    high.array() += kReach * longest;
    tree.for_each_in(low, high, [&](Index i, const Vector3d& p) {
      const double outside = std::min(distance(p, {a, b, c}, longest), distance(p, {a, c, d}, longest));
      if (outside < best[i]) best[i] = outside, found[i] = q;
    });
  }
  return found;
}

}  // namespace qmorph
