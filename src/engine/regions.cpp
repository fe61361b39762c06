#include "engine/regions.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/z_curve.hpp"
#include "qmorph/error.hpp"

namespace qmorph {
namespace {

/// Union-find; the smallest member is the root, so that numbering does not depend on the order of unions.
class Sets {
 public:
  explicit Sets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
  Index root(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(Index i, Index j) {
    i = root(i), j = root(j);
    if (i != j) parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<Index> parent_;
};

/// A side of a triangle: corner 3 * triangle + i, from that corner's node to the next corner's.
struct Sides {
  explicit Sides(const Patch& patch) : patch_(patch), start_(patch.points.size() + 1, 0) {
    for (const auto& t : patch.triangles)
      for (Index v : t) ++start_[v + 1];
    for (std::size_t v = 0; v + 1 < start_.size(); ++v) start_[v + 1] += start_[v];
    by_origin_.resize(patch.triangles.size() * 3);
    std::vector<Index> fill(start_.begin(), start_.end() - 1);
    for (Index c = 0; c < by_origin_.size(); ++c) by_origin_[fill[from(c)]++] = c;
  }
  Index from(Index corner) const { return patch_.triangles[corner / 3][corner % 3]; }
  Index to(Index corner) const { return patch_.triangles[corner / 3][(corner + 1) % 3]; }
  /// The side that runs from a to b, or kNone. O(valence). `count` gets how many there are.
  Index find(Index a, Index b, int* count = nullptr) const {
    Index found = kNone;
    int n = 0;
    for (Index k = start_[a]; k < start_[a + 1]; ++k)
      if (to(by_origin_[k]) == b) {
        if (found == kNone) found = by_origin_[k];
        ++n;
      }
    if (count) *count = n;
    return found;
  }
  Index count() const { return Index(by_origin_.size()); }

 private:
  const Patch& patch_;
  std::vector<Index> start_, by_origin_;
};

std::vector<bool> constrained_sides(const Patch& patch, const Sides& sides) {
  std::vector<bool> constrained(sides.count(), false);
  for (const auto& [a, b] : patch.constraints)
    for (Index side : {sides.find(a, b), sides.find(b, a)})
      if (side != kNone) constrained[side] = true;
  return constrained;
}

void require_manifold(const Patch& patch, const Sides& sides) {
  for (Index c = 0; c < sides.count(); ++c) {
    int count = 0;
    sides.find(sides.from(c), sides.to(c), &count);
    if (count > 1)
      throw SurfaceError("two triangles lie on the same side of the edge from " +
                         describe(patch.points[sides.from(c)]) + " to " + describe(patch.points[sides.to(c)]) +
                         "; remove overlapping triangles or orient them alike");
  }
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
  const Sides sides(patch);
  require_manifold(patch, sides);
  const std::vector<bool> constrained = constrained_sides(patch, sides);
  const auto triangles = Index(patch.triangles.size());

  // Corners that belong to one fan are joined across every edge that is not cut.
  Sets fans(triangles * 3), together(triangles);
  std::vector<bool> open(triangles * 3, true);
  for (Index c = 0; c < sides.count(); ++c) {
    if (constrained[c]) continue;
    const Index other = sides.find(sides.to(c), sides.from(c));
    if (other == kNone) continue;
    open[c] = false;
    const Index c_next = c - c % 3 + (c + 1) % 3, other_next = other - other % 3 + (other + 1) % 3;
    fans.unite(c, other_next);
    fans.unite(c_next, other);
    together.unite(c / 3, other / 3);
  }

  std::vector<bool> must_stay(patch.points.size(), false);
  for (Index v : patch.fixed) must_stay[v] = true;
  for (const auto& [a, b] : patch.constraints) must_stay[a] = must_stay[b] = true;

  std::vector<Region> regions;
  std::vector<Index> region_of(triangles, kNone), vertex_of(triangles * 3, kNone);
  for (Index t : spatial_order(patch, plane_points)) {
    const Index root = together.root(t);
    if (region_of[root] == kNone) {
      region_of[root] = Index(regions.size());
      regions.emplace_back();
    }
    Region& region = regions[region_of[root]];
    std::array<Index, 3> corners{};
    for (Index i = 0; i < 3; ++i) {
      const Index c = 3 * t + i, fan = fans.root(c), node = patch.triangles[t][i];
      if (vertex_of[fan] == kNone) {
        vertex_of[fan] = Index(region.points.size());
        region.points.push_back(plane_points[node]);
        region.node.push_back(node);
        if (must_stay[node]) region.fixed.push_back(vertex_of[fan]);
      }
      corners[i] = vertex_of[fan];
      region.boundary_sides += open[c];
      region.open.push_back(open[c]);
    }
    region.triangles.push_back(corners);
    region.row.push_back(t);
  }
  return regions;
}

}  // namespace qmorph
