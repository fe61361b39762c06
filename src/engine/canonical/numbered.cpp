// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/canonical/numbered.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "geometry/z_curve.hpp"

namespace qmorph::canonical {
namespace {

using Eigen::Vector3d;

/// By coordinates, one after another.
bool is_before(const Vector3d& a, const Vector3d& b) {
  if (a.x() != b.x()) return a.x() < b.x();
  if (a.y() != b.y()) return a.y() < b.y();
  return a.z() < b.z();
}

template <std::size_t N>
bool is_before(const std::array<Index, N>& one, const std::array<Index, N>& other,
               const std::vector<Vector3d>& points) {
  for (std::size_t i = 0; i < N; ++i) {
    const Vector3d &a = points[one[i]], &b = points[other[i]];
    if (a != b) return is_before(a, b);
  }
  return false;
}

/// The element from its lowest corner on; if two corners are at the same place, from that which makes it lowest.
template <std::size_t N>
std::array<Index, N> from_lowest(const std::array<Index, N>& element, const std::vector<Vector3d>& points) {
  const auto starting_at = [&](std::size_t start) {
    std::array<Index, N> turned{};
    for (std::size_t i = 0; i < N; ++i) turned[i] = element[(start + i) % N];
    return turned;
  };
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < N; ++i) {
    const Vector3d &here = points[element[i]], &there = points[element[lowest]];
    if (here.x() != there.x() ? here.x() < there.x() : is_before(starting_at(i), starting_at(lowest), points))
      lowest = i;
  }
  return starting_at(lowest);
}

/// From their lowest corners on, along a Z-curve through their middles. `rows` gets those that they had.
template <std::size_t N>
std::vector<std::array<Index, N>> in_order(const std::vector<std::array<Index, N>>& elements, bool turns_over,
                                           const std::vector<Vector3d>& points, std::vector<Index>& rows) {
  std::vector<std::array<Index, N>> turned;
  std::vector<Vec2> middles;
  turned.reserve(elements.size());
  middles.reserve(elements.size());
  for (auto element : elements) {
    if (turns_over) std::reverse(element.begin(), element.end());
    turned.push_back(from_lowest(element, points));
    Vec2 sum = Vec2::Zero();
    for (Index v : turned.back()) sum += points[v].template head<2>();
    middles.push_back(sum / double(N));
  }
  rows = along_z_curve(middles, [&](Index a, Index b) { return is_before(turned[a], turned[b], points); });
  std::vector<std::array<Index, N>> ordered;
  ordered.reserve(rows.size());
  for (Index row : rows) ordered.push_back(turned[row]);
  return ordered;
}

/// Numbers of nodes, as elements come upon them.
class NodeNumbers {
 public:
  explicit NodeNumbers(std::size_t nodes) : number_(nodes, kNone) { row_.reserve(nodes); }

  template <std::size_t N>
  void number(std::vector<std::array<Index, N>>& elements) {
    for (auto& element : elements)
      for (Index& v : element) v = of(v);
  }
  Index of(Index row) {
    if (number_[row] == kNone) number_[row] = Index(row_.size()), row_.push_back(row);
    return number_[row];
  }
  /// Those that no element uses, in the order of their coordinates.
  void number_rest(const std::vector<Vector3d>& points) {
    if (row_.size() == points.size()) return;
    std::vector<Index> rest;
    for (Index row = 0; row < points.size(); ++row)
      if (number_[row] == kNone) rest.push_back(row);
    std::stable_sort(rest.begin(), rest.end(), [&](Index a, Index b) { return is_before(points[a], points[b]); });
    for (Index row : rest) of(row);
  }
  std::vector<Index> take_rows() { return std::move(row_); }

 private:
  std::vector<Index> number_, row_;
};

/// The caller's corners of the quads that stay, if the mesh begins with them as they are in `from`.
bool begins_with_quads(const QuadMesh& mesh, const Patch& from) {
  const auto is_same = [&](Index v, Index of) { return mesh.source[v] == of; };
  return mesh.quads.size() >= from.quads.size() &&
         std::equal(from.quads.begin(), from.quads.end(), mesh.quads.begin(), [&](const auto& quad, const auto& now) {
           return std::equal(now.begin(), now.end(), quad.begin(), is_same);
         });
}

/// The rows of the mesh's nodes in the caller's order: nodes of the input as they came, then new ones.
std::vector<Index> callers_order(const std::vector<Index>& callers_row, std::size_t input_nodes) {
  std::vector<std::size_t> start(input_nodes + 2, 0);
  const auto place = [&](Index row) { return row == kNone ? input_nodes : std::size_t(row); };
  for (Index row : callers_row) ++start[place(row) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Index> order(callers_row.size());
  for (Index v = 0; v < callers_row.size(); ++v) order[start[place(callers_row[v])]++] = v;
  return order;
}

}  // namespace

std::optional<Numbered> numbered(const Patch& patch) {
  if (patch.triangles.empty() && patch.quads.empty()) return {};
  Numbered result;
  result.frame = find_frame(patch);
  std::vector<Vector3d> points;
  points.reserve(patch.points.size());
  for (const Vector3d& p : patch.points) points.push_back(result.frame.to_own(p));

  Patch& own = result.patch;
  own.is_smooth = patch.is_smooth;
  std::vector<Index> triangle_rows;
  own.triangles = in_order(patch.triangles, result.frame.turns_over, points, triangle_rows);
  own.quads = in_order(patch.quads, result.frame.turns_over, points, result.quad);
  NodeNumbers numbers(points.size());
  numbers.number(own.triangles);
  numbers.number(own.quads);
  numbers.number_rest(points);
  for (const auto& [a, b] : patch.constraints) {
    const auto [low, high] = std::minmax({numbers.of(a), numbers.of(b)});
    own.constraints.push_back({low, high});
  }
  for (Index v : patch.fixed) own.fixed.push_back(numbers.of(v));
  std::sort(own.constraints.begin(), own.constraints.end());
  std::sort(own.fixed.begin(), own.fixed.end());
  result.node = numbers.take_rows();
  own.points.reserve(points.size());
  for (Index row : result.node) own.points.push_back(points[row]);
  return result;
}

QuadMesh in_callers_terms(const QuadMesh& mesh, const Patch& patch, const Numbered& from) {
  std::vector<Index> callers_row;
  callers_row.reserve(mesh.source.size());
  for (Index source : mesh.source) callers_row.push_back(source == kNone ? kNone : from.node[source]);
  const std::vector<Index> order = callers_order(callers_row, patch.points.size());
  QuadMesh result;
  result.points.reserve(order.size());
  result.source.reserve(order.size());
  std::vector<Index> now(order.size()), now_of_source(patch.points.size(), kNone);
  for (Index v : order) {
    const Index source = mesh.source[v], row = callers_row[v];
    now[v] = Index(result.points.size());
    if (source != kNone) now_of_source[row] = now[v];
    const bool is_still = source != kNone && mesh.points[v] == from.patch.points[source];
    result.points.push_back(is_still ? patch.points[row] : from.frame.to_model(mesh.points[v]));
    result.source.push_back(row);
  }
  const auto renumbered = [&](auto element) {
    for (Index& v : element) v = now[v];
    if (from.frame.turns_over) std::reverse(element.begin() + 1, element.end());
    return element;
  };
  result.triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) result.triangles.push_back(renumbered(t));
  result.quads.reserve(mesh.quads.size());
  for (const auto& q : mesh.quads) result.quads.push_back(renumbered(q));
  if (begins_with_quads(mesh, from.patch))
    for (std::size_t i = 0; i < patch.quads.size(); ++i)
      for (std::size_t k = 0; k < 4; ++k) result.quads[i][k] = now_of_source[patch.quads[i][k]];
  return result;
}

}  // namespace qmorph::canonical
