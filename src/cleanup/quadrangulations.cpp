// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/quadrangulations.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace qmorph::cleanup {
namespace {

constexpr int kFewestInside = 3, kMostInside = 5, kIdealInside = 4;

using Polygon = std::vector<int>;

/// What is left of `polygon` after a step; a part with two nodes is an edge and no polygon. `first_new`: the number of
/// the step's first new node.
std::vector<Polygon> rest_of(const Polygon& polygon, const FillStep& step, int first_new) {
  const int m = int(polygon.size());
  std::vector<Polygon> rest;
  const auto add = [&](int from, int to, std::initializer_list<int> more) {
    Polygon part(polygon.begin() + from, polygon.begin() + to + 1);
    part.insert(part.end(), more);
    if (part.size() > 2) rest.push_back(std::move(part));
  };
  if (step.ahead == FillStep::kNew && step.back == FillStep::kNew) {
    add(1, m - 1, {polygon[0], first_new + 1, first_new});
  } else if (step.ahead == FillStep::kNew) {
    add(step.back, m - 1, {polygon[0]});
    add(1, step.back, {first_new});
  } else if (step.back == FillStep::kNew) {
    add(1, step.ahead, {});
    add(step.ahead, m - 1, {polygon[0], first_new});
  } else {
    add(1, step.ahead, {});
    add(step.ahead, step.back, {});
    add(step.back, m - 1, {polygon[0]});
  }
  return rest;
}

class Search {
 public:
  Search(const std::vector<RingNode>& ring, const SearchLimits& limits)
      : ring_(ring), limits_(limits), most_cost_(limits.most_cost) {
    for (const RingNode& node : ring) edges_.push_back(node.outer);
  }

  void run() {
    Polygon all(ring_.size());
    std::iota(all.begin(), all.end(), 0);
    search({all});
  }

  std::vector<Quadrangulation> found;
  std::size_t steps = 0;

 private:
  RingNode node(std::size_t v) const {
    return v < ring_.size() ? ring_[v] : RingNode{0, kIdealInside, kFewestInside, kMostInside};
  }

  /// What the nodes cost at least, whatever becomes of the polygons that are left; more than allowed if that is
  /// nothing.
  int least_cost(const std::vector<Polygon>& left) const {
    std::vector<char> open(edges_.size(), 0);
    for (const Polygon& polygon : left)
      for (int v : polygon) open[std::size_t(v)] = 1;
    int cost = 0;
    for (std::size_t v = 0; v < edges_.size(); ++v) {
      const RingNode is = node(v);
      if (edges_[v] > is.most || (!open[v] && edges_[v] < is.fewest)) return most_cost_ + 1;
      const int excess = open[v] ? std::max(0, edges_[v] - is.ideal) : edges_[v] - is.ideal;
      cost += excess * excess;
    }
    return cost;
  }

  void search(std::vector<Polygon> left) {
    if (steps >= limits_.most_steps) return;
    ++steps;
    const int cost = least_cost(left);
    if (cost > most_cost_) return;
    if (left.empty()) return keep(cost);
    const Polygon polygon = std::move(left.back());
    left.pop_back();
    const int m = int(polygon.size());
    for (int ahead = 2; ahead < m; ahead += 2)
      for (int back = ahead + 1; back < m; back += 2) take({ahead, back}, polygon, left);
    for (int ahead = 2; ahead < m; ahead += 2) take({ahead, FillStep::kNew}, polygon, left);
    for (int back = 3; back < m; back += 2) take({FillStep::kNew, back}, polygon, left);
    take({}, polygon, left);
  }

  void take(const FillStep& step, const Polygon& polygon, const std::vector<Polygon>& left) {
    const int first_new = int(edges_.size()), m = int(polygon.size());
    const int count = (step.ahead == FillStep::kNew) + (step.back == FillStep::kNew);
    if (std::size_t(first_new + count) > ring_.size() + std::size_t(limits_.most_inner)) return;
    edges_.resize(edges_.size() + std::size_t(count), 0);
    const int ahead = step.ahead == FillStep::kNew ? first_new : polygon[std::size_t(step.ahead)];
    const int back = step.back == FillStep::kNew ? first_new + count - 1 : polygon[std::size_t(step.back)];
    if (!has_room({polygon[0], polygon[1], ahead, back})) return void(edges_.resize(std::size_t(first_new)));
    const std::size_t before = drawn_.size();
    if (step.ahead != 2) drawn_.push_back({polygon[1], ahead});
    if (step.ahead == FillStep::kNew || step.back != step.ahead + 1) drawn_.push_back({ahead, back});
    if (step.back != m - 1) drawn_.push_back({back, polygon[0]});
    for (std::size_t i = before; i < drawn_.size(); ++i)
      for (int v : drawn_[i]) ++edges_[std::size_t(v)];
    if (are_new(before)) {
      std::vector<Polygon> rest = left;
      for (Polygon& part : rest_of(polygon, step, first_new)) rest.push_back(std::move(part));
      path_.push_back(step);
      search(std::move(rest));
      path_.pop_back();
    }
    for (std::size_t i = before; i < drawn_.size(); ++i)
      for (int v : drawn_[i]) --edges_[std::size_t(v)];
    drawn_.resize(before);
    edges_.resize(std::size_t(first_new));
  }

  /// Whether no edge from drawn_[first] on joins nodes that another joins.
  bool are_new(std::size_t first) const {
    const int n = int(ring_.size());
    for (std::size_t i = first; i < drawn_.size(); ++i) {
      const auto [a, b] = drawn_[i];
      if (a < n && b < n && ((a + 1) % n == b || (b + 1) % n == a)) return false;
      for (std::size_t k = 0; k < i; ++k)
        if (drawn_[k] == std::array{a, b} || drawn_[k] == std::array{b, a}) return false;
    }
    return true;
  }

  /// Whether the corners of a quad that lie between nodes of the ring are convex.
  bool has_room(const std::array<int, 4>& quad) const {
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<const RingNode*, 3> at{};  // the corner and its neighbours
      bool is_known = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto v = std::size_t(quad[(i + (k == 2 ? 3 : k)) % 4]);
        is_known = is_known && v < ring_.size();
        if (is_known) at[k] = &ring_[v];
      }
      if (!is_known) continue;
      const bool moves = at[0]->moves || at[1]->moves || at[2]->moves;
      if (corner_sine(at[0]->point, at[1]->point, at[2]->point) <= (moves ? 0 : limits_.least_sine)) return false;
    }
    return true;
  }

  void keep(int cost) {
    const auto after =
        std::upper_bound(found.begin(), found.end(), cost, [](int c, const Quadrangulation& q) { return c < q.cost; });
    found.insert(after, {cost, path_});
    if (found.size() > limits_.most_found) found.pop_back();
    if (found.size() == limits_.most_found) most_cost_ = found.back().cost - 1;
  }

  const std::vector<RingNode>& ring_;
  const SearchLimits& limits_;
  int most_cost_;
  std::vector<int> edges_;                 ///< by node: how many it has so far; new nodes follow those of the ring
  std::vector<std::array<int, 2>> drawn_;  ///< edges inside the ring so far
  std::vector<FillStep> path_;
};

/// Draws a quadrangulation into a face.
class Drawing {
 public:
  Drawing(kernel::Mesh& mesh, const Vec2& middle, std::vector<Index>& nodes)
      : mesh_(mesh), middle_(middle), nodes_(nodes) {}

  bool run(Index first, const Quadrangulation& quadrangulation) {
    std::vector<Index> left{first};
    for (const FillStep& step : quadrangulation.steps) {
      const Index base = left.back();
      left.pop_back();
      if (!take(base, step, left)) return false;
    }
    return true;
  }

 private:
  /// Draws the quad on `base`, a half-edge, and appends the first half-edges of what is left of its face.
  bool take(Index base, const FillStep& step, std::vector<Index>& left) {
    std::vector<Index> side;  // of the polygon
    for (Index h : mesh_.loop_from(base)) side.push_back(h);
    const std::size_t m = side.size(), ahead = std::size_t(step.ahead), back = std::size_t(step.back);
    const bool new_ahead = step.ahead == FillStep::kNew, new_back = step.back == FillStep::kNew;
    if (new_ahead && new_back) return path(side[1], side[0], 2) && add(left, side[1]);
    if (new_ahead) {
      if (!path(side[1], side[back], 1)) return false;
      if (back < m - 1 && !(path(side[back], side[0], 0) && add(left, side[back]))) return false;
      return add(left, side[1]);
    }
    if (ahead > 2 && !(path(side[1], side[ahead], 0) && add(left, side[1]))) return false;
    if (new_back) return path(side[ahead], side[0], 1) && add(left, side[ahead]);
    if (back > ahead + 1 && !(path(side[ahead], side[back], 0) && add(left, side[ahead]))) return false;
    return back == m - 1 || (path(side[back], side[0], 0) && add(left, side[back]));
  }

  static bool add(std::vector<Index>& left, Index h) {
    left.push_back(h);
    return true;
  }

  /// New edges from origin(g) to origin(h) through so many new nodes, the quad on their left.
  bool path(Index g, Index h, int count) {
    if (count == 0 && mesh_.find(mesh_.origin(g), mesh_.origin(h)) != kNone) return false;
    Index e = mesh_.split_face(g, h);
    for (; count > 0; --count) {
      nodes_.push_back(mesh_.split_edge(e, middle_));
      e = mesh_.next(e);
    }
    return true;
  }

  kernel::Mesh& mesh_;
  const Vec2 middle_;
  std::vector<Index>& nodes_;
};

}  // namespace

std::vector<Quadrangulation> find_quadrangulations(const std::vector<RingNode>& ring, const SearchLimits& limits,
                                                   std::size_t& steps) {
  Search search(ring, limits);
  search.run();
  steps += search.steps;
  return std::move(search.found);
}

bool fill(kernel::Mesh& mesh, const std::vector<Index>& ring, const std::vector<Index>& faces,
          const Quadrangulation& quadrangulation, std::vector<Index>& nodes) {
  Vec2 middle = Vec2::Zero();
  for (Index h : ring) middle += mesh.point(mesh.origin(h)) / double(ring.size());
  mesh.make_face(ring, faces);
  return Drawing(mesh, middle, nodes).run(ring[0], quadrangulation);
}

}  // namespace qmorph::cleanup
