#include "engine/regions.hpp"

#include <algorithm>

#include "geometry/z_curve.hpp"
#include "qmorph/error.hpp"

namespace qmorph {
namespace {

/// Sides of triangles: side c runs from the node of corner c to that of the next corner. Corners of triangle k are 3 k, 3 k + 1, 3 k + 2.
class Sides {
 public:
  Sides(const Patch& patch, const std::vector<Index>& order)
      : first_(patch.points.size(), kNone), following_(3 * order.size()), opposite_(3 * order.size(), kNone) {
    node_.reserve(3 * order.size());
    for (Index t : order) node_.insert(node_.end(), patch.triangles[t].begin(), patch.triangles[t].end());
    for (Index c = 0; c < node_.size(); ++c) add(c, patch);
    for (const auto& [a, b] : patch.constraints) cut(find(a, b));
  }

  static Index next(Index c) { return c % 3 == 2 ? c - 2 : c + 1; }
  static Index previous(Index c) { return c % 3 == 0 ? c + 2 : c - 1; }
  Index node(Index c) const { return node_[c]; }
  /// The same edge's side in the other triangle; kNone on the boundary and on a constraint.
  Index opposite(Index c) const { return opposite_[c]; }

 private:
  /// The side between a and b, in either direction, that came first. O(valence): among the sides from one lower node, the sum of both
  /// nodes tells which it is.
  Index find(Index a, Index b) const {
    Index s = first_[std::min(a, b)];
    while (s != kNone && node_[s] + node_[next(s)] != a + b) s = following_[s];
    return s;
  }

  void add(Index c, const Patch& patch) {
    const Index a = node_[c], b = node_[next(c)], other = find(a, b);
    if (other == kNone) {
      following_[c] = first_[std::min(a, b)];
      first_[std::min(a, b)] = c;
      return;
    }
    if (node_[other] == a || opposite_[other] != kNone)
      throw SurfaceError("two triangles lie on the same side of the edge from " + describe(patch.points[a]) + " to " +
                         describe(patch.points[b]) + "; remove overlapping triangles or orient them alike");
    opposite_[c] = other;
    opposite_[other] = c;
  }

  void cut(Index c) {
    if (c == kNone) return;
    if (opposite_[c] != kNone) opposite_[opposite_[c]] = kNone;
    opposite_[c] = kNone;
  }

  std::vector<Index> node_;               ///< by corner
  std::vector<Index> first_, following_;  ///< sides in a chain from the lower node of each edge, one for each edge
  std::vector<Index> opposite_;           ///< by side
};

/// The number of the region of each triangle; regions are numbered as they come. `sizes` gets their triangles.
std::vector<Index> number_regions(const Sides& sides, Index triangles, std::vector<std::size_t>& sizes) {
  std::vector<Index> region(triangles);  // at first a union-find, in which the lowest triangle of a set is the root
  const auto root = [&](Index t) {
    while (region[t] != t) t = region[t] = region[region[t]];
    return t;
  };
  for (Index t = 0; t < triangles; ++t) {
    region[t] = t;
    for (Index c = 3 * t; c < 3 * t + 3; ++c) {
      if (sides.opposite(c) >= c) continue;  // that triangle comes later, if there is one
      const Index a = root(t), b = root(sides.opposite(c) / 3);
      region[std::max(a, b)] = std::min(a, b);
    }
  }
  for (Index t = 0; t < triangles; ++t) {
    const bool is_first = region[t] == t;
    region[t] = is_first ? Index(sizes.size()) : region[region[t]];
    if (is_first) sizes.push_back(0);
    ++sizes[region[t]];
  }
  return region;
}

/// Calls visit(corner) for corner c and all others of its fan.
template <class Visit>
void for_fan(const Sides& sides, Index c, const Visit& visit) {
  visit(c);
  Index e = sides.opposite(c);
  for (; e != kNone; e = sides.opposite(e)) {
    e = Sides::next(e);
    if (e == c) return;  // all round
    visit(e);
  }
  for (e = c; (e = sides.opposite(Sides::previous(e))) != kNone;) visit(e);
}

/// What lies close together on the surface shall do so in memory, however the mesher has numbered it: on a million triangles in
/// random order that halves the time of a conversion.
std::vector<Index> spatial_order(const Patch& patch, const std::vector<Vec2>& plane_points) {
  std::vector<Vec2> middles;
  middles.reserve(patch.triangles.size());
  for (const auto& t : patch.triangles)
    middles.push_back((plane_points[t[0]] + plane_points[t[1]] + plane_points[t[2]]) / 3);
  return along_z_curve(middles);
}

}  // namespace

std::vector<Region> cut_into_regions(const Patch& patch, const std::vector<Vec2>& plane_points) {
  const std::vector<Index> order = spatial_order(patch, plane_points);
  const Sides sides(patch, order);
  std::vector<std::size_t> sizes;
  const std::vector<Index> region_of = number_regions(sides, Index(order.size()), sizes);

  std::vector<bool> must_stay(patch.points.size(), false);
  for (Index v : patch.fixed) must_stay[v] = true;
  for (const auto& [a, b] : patch.constraints) must_stay[a] = must_stay[b] = true;

  std::vector<Region> regions(sizes.size());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    regions[r].triangles.reserve(sizes[r]);
    regions[r].row.reserve(sizes[r]);
    regions[r].open.reserve(3 * sizes[r]);
  }
  std::vector<Index> vertex_of(3 * order.size(), kNone);
  for (Index k = 0; k < order.size(); ++k) {
    Region& region = regions[region_of[k]];
    std::array<Index, 3> corners{};
    for (Index i = 0; i < 3; ++i) {
      const Index c = 3 * k + i, node = sides.node(c);
      if (vertex_of[c] == kNone) {
        const auto vertex = Index(region.points.size());
        for_fan(sides, c, [&](Index e) { vertex_of[e] = vertex; });
        region.points.push_back(plane_points[node]);
        region.node.push_back(node);
        if (must_stay[node]) region.fixed.push_back(vertex);
      }
      corners[i] = vertex_of[c];
      region.open.push_back(sides.opposite(c) == kNone);
      region.boundary_sides += region.open.back();
    }
    region.triangles.push_back(corners);
    region.row.push_back(order[k]);
  }
  return regions;
}

}  // namespace qmorph
