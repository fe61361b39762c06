// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/regions.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "qmorph/error.hpp"

namespace qmorph {
namespace {

/// The triangles, with nodes that are numbered as they come. Side c runs from the node of corner c to that of the next
/// corner. Corners of triangle k are 3 k, 3 k + 1, 3 k + 2.
class Sides {
 public:
  Sides(const Patch& patch, EdgesOfMany many) : opposite_(3 * patch.triangles.size(), kNone) {
    take_nodes(patch);
    first_.assign(row_.size(), kNone);
    edges_.reserve(node_.size() / 2 + node_.size() / 16);
    const std::vector<Index> torn = many == EdgesOfMany::part ? sides_of_many(patch) : std::vector<Index>();
    std::size_t next_torn = 0;
    for (Index c = 0; c < node_.size(); ++c) {
      if (next_torn < torn.size() && torn[next_torn] == c)
        ++next_torn;
      else
        add(c, patch);
    }
    for (const auto& [a, b] : patch.constraints) cut(number_[a], number_[b]);
  }

  static Index next(Index c) { return c % 3 == 2 ? c - 2 : c + 1; }
  static Index previous(Index c) { return c % 3 == 0 ? c + 2 : c - 1; }
  Index nodes() const { return Index(row_.size()); }
  Index node(Index c) const { return node_[c]; }
  /// Of Patch::points.
  Index row(Index node) const { return row_[node]; }
  /// The same edge's side in the other triangle; kNone on the boundary and on a constraint.
  Index opposite(Index c) const { return opposite_[c]; }

  /// Where several fans of triangles meet at a node, all but the first get one of their own. Returns the rows of nodes
  /// that lie inside of one fan, and have others, or quads, beside: those touch the surface there.
  std::vector<Index> separate_fans(const Patch& patch) {
    std::vector<bool> is_taken(nodes(), false), is_inside = is_taken, is_done(node_.size(), false);
    std::vector<bool> has_quad(patch.points.size(), false);
    for (const auto& quad : patch.quads)
      for (Index row : quad) has_quad[row] = true;
    std::vector<Index> touched;
    for (Index c = 0; c < node_.size(); ++c) {
      if (is_done[c]) continue;
      const Index node = node_[c], row = row_[node], own = is_taken[node] ? nodes() : node;
      if (own != node) row_.push_back(row);
      const bool is_closed = for_fan(c, [&](Index e) { node_[e] = own, is_done[e] = true; });
      if ((is_closed && has_quad[row]) || (own != node && (is_closed || is_inside[node]))) touched.push_back(row);
      is_taken[node] = true;
      if (is_closed) is_inside[node] = true;
    }
    return touched;
  }

 private:
  void take_nodes(const Patch& patch) {
    number_.assign(patch.points.size(), kNone);
    node_.reserve(3 * patch.triangles.size());
    row_.reserve(patch.points.size());
    for (const auto& t : patch.triangles) node_.insert(node_.end(), t.begin(), t.end());
    for (Index& v : node_) {
      if (number_[v] == kNone) number_[v] = nodes(), row_.push_back(v), corners_.push_back(0);
      v = number_[v];
      ++corners_[v];
    }
  }

  /// Sides on edges that have three triangles or more, or that are constraints and not passed in both directions;
  /// ascending.
  std::vector<Index> sides_of_many(const Patch& patch) const {
    struct Side {
      Index high, side;
      bool operator<(const Side& other) const { return std::tie(high, side) < std::tie(other.high, other.side); }
    };
    const auto ends = [&](Index c) -> std::pair<Index, Index> { return std::minmax(node_[c], node_[next(c)]); };
    std::vector<Index> last(nodes(), 0);  // by lower node: where its sides end
    for (Index c = 0; c < node_.size(); ++c) ++last[ends(c).first];
    std::partial_sum(last.begin(), last.end(), last.begin());
    std::vector<Index> place = last;
    std::vector<Side> sides(node_.size());
    for (Index c = Index(node_.size()); c-- > 0;) sides[--place[ends(c).first]] = {ends(c).second, c};
    std::vector<std::pair<Index, Index>> lines;
    for (const auto& [a, b] : patch.constraints)
      if (number_[a] != kNone && number_[b] != kNone) lines.push_back(std::minmax(number_[a], number_[b]));
    std::sort(lines.begin(), lines.end());
    std::vector<Index> many;
    for (Index low = 0; low < nodes(); ++low) {
      std::sort(sides.begin() + place[low], sides.begin() + last[low]);
      for (Index k = place[low], after = k; k < last[low]; k = after) {
        while (after < last[low] && sides[after].high == sides[k].high) ++after;
        const bool alike = after - k == 2 && node_[sides[k].side] == node_[sides[k + 1].side];
        if (after - k > 2 || (alike && std::binary_search(lines.begin(), lines.end(), std::pair(low, sides[k].high))))
          for (; k < after; ++k) many.push_back(sides[k].side);
      }
    }
    std::sort(many.begin(), many.end());
    return many;
  }

  /// Of two nodes the one with fewer corners first, so that chains are short even where fans meet.
  std::pair<Index, Index> in_order(Index a, Index b) const {
    const bool is_a = corners_[a] != corners_[b] ? corners_[a] < corners_[b] : a < b;
    return is_a ? std::pair(a, b) : std::pair(b, a);
  }

  /// The side between a and b, in either direction, that came first.
  Index find(Index a, Index b) const {
    const auto [from, to] = in_order(a, b);
    for (Index e = first_[from]; e != kNone; e = edges_[e].following)
      if (edges_[e].to == to) return edges_[e].side;
    return kNone;
  }

  void add(Index c, const Patch& patch) {
    const Index a = node_[c], b = node_[next(c)], other = find(a, b);
    if (other == kNone) {
      const auto [from, to] = in_order(a, b);
      Index& first = first_[from];
      edges_.push_back({to, c, first});
      first = Index(edges_.size() - 1);
      return;
    }
    if (node_[other] == a || opposite_[other] != kNone)
      throw SurfaceError(
          "two triangles lie on the same side of the edge from " + describe(patch.points[row_[a]]) + " to " +
              describe(patch.points[row_[b]]) + "; remove overlapping triangles or orient them alike",
          {.kind = ErrorKind::not_manifold, .place = patch.points[row_[a]], .subject = node_row(row_[a])});
    opposite_[c] = other;
    opposite_[other] = c;
  }

  void cut(Index a, Index b) {
    if (a == kNone || b == kNone) return;
    const Index c = find(a, b);
    if (c == kNone) return;
    if (opposite_[c] != kNone) opposite_[opposite_[c]] = kNone;
    opposite_[c] = kNone;
  }

  /// Calls visit(corner) for corner c and all others of its fan. True if they go all round.
  template <class Visit>
  bool for_fan(Index c, const Visit& visit) const {
    visit(c);
    Index e = opposite_[c];
    for (; e != kNone; e = opposite_[e]) {
      e = next(e);
      if (e == c) return true;
      visit(e);
    }
    for (e = c; (e = opposite_[previous(e)]) != kNone;) visit(e);
    return false;
  }

  struct Edge {
    Index to, side, following;
  };
  std::vector<Index> number_, row_;  ///< nodes of rows of Patch::points, and back
  std::vector<Index> node_;          ///< by corner
  std::vector<Index> corners_;       ///< by node: how many triangles meet there
  std::vector<Index> first_;         ///< by node: its first edge in a chain of those that are kept there
  std::vector<Edge> edges_;
  std::vector<Index> opposite_;  ///< by side
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

}  // namespace

std::vector<std::array<Index, 2>> boundary_edges(const Region& region) {
  std::vector<std::array<Index, 2>> edges;
  for (Index side = 0; side < region.open.size(); ++side)
    if (region.open[side])
      edges.push_back({region.triangles[side / 3][side % 3], region.triangles[side / 3][(side + 1) % 3]});
  return edges;
}

std::vector<Region> cut_into_regions(const Patch& patch, const std::vector<Vec2>& plane_points, EdgesOfMany many) {
  Sides sides(patch, many);
  const std::vector<Index> touched = sides.separate_fans(patch);
  std::vector<std::size_t> sizes;
  const std::vector<Index> region_of = number_regions(sides, Index(patch.triangles.size()), sizes);

  std::vector<bool> must_stay(patch.points.size(), false);
  for (Index v : patch.fixed) must_stay[v] = true;
  for (Index v : touched) must_stay[v] = true;
  for (const auto& [a, b] : patch.constraints) must_stay[a] = must_stay[b] = true;

  std::vector<Region> regions(sizes.size());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    regions[r].triangles.reserve(sizes[r]);
    regions[r].row.reserve(sizes[r]);
    regions[r].open.assign(3 * sizes[r], false);
  }
  std::vector<Index> vertex_of(sides.nodes(), kNone);
  for (Index k = 0; k < patch.triangles.size(); ++k) {
    Region& region = regions[region_of[k]];
    std::array<Index, 3> corners{};
    for (Index i = 0; i < 3; ++i) {
      const Index c = 3 * k + i;
      Index& vertex = vertex_of[sides.node(c)];
      if (vertex == kNone) {
        const Index row = sides.row(sides.node(c));
        vertex = Index(region.node.size());
        region.node.push_back(row);
        if (must_stay[row]) region.fixed.push_back(vertex);
      }
      corners[i] = vertex;
      if (sides.opposite(c) == kNone) region.open[3 * region.triangles.size() + i] = true, ++region.boundary_sides;
    }
    region.triangles.push_back(corners);
    region.row.push_back(k);
  }
  for (Region& region : regions) {
    region.points.reserve(region.node.size());
    for (Index row : region.node) region.points.push_back(plane_points[row]);
  }
  return regions;
}

}  // namespace qmorph
