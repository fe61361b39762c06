// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/result.hpp"

#include <algorithm>

namespace qmorph::space {

using Eigen::Vector3d;

std::vector<std::array<Index, 2>> kept_constraints(const Patch& before, const QuadMesh& after) {
  std::vector<Index> row(before.points.size(), kNone);
  for (Index i = 0; i < after.source.size(); ++i)
    if (after.source[i] != kNone) row[after.source[i]] = i;
  std::vector<std::array<Index, 2>> constraints;
  for (const auto& [a, b] : before.constraints)
    if (row[a] != kNone && row[b] != kNone) constraints.push_back({row[a], row[b]});
  return constraints;
}

Result::Result(const Patch& before, const QuadMesh& after)
    : after_(after),
      reference_(before),
      normals_(reference_.surface),
      sides_(after.points.size(), after.triangles, after.quads, kept_constraints(before, after)),
      triangle_(
          locate({reference_.surface, after.points, after.triangles, after.quads, after.source}, sides_, normals_)),
      foot_(after.points.size()),
      normal_(after.points.size(), Vector3d::Zero()) {
  std::vector<char> is_inside(after.points.size(), 1);
  for (Index side = 0; side < sides_.slots(); ++side)
    if (sides_.node(side) != kNone && sides_.opposite(side) == kNone)
      is_inside[sides_.node(side)] = is_inside[sides_.target(side)] = 0;
  for (Index side = 0; side < sides_.slots(); ++side) {
    const Index v = sides_.node(side);
    if (v == kNone || !is_inside[v] || foot_[v].triangle != kNone) continue;
    foot_[v] = normals_.closest(after.points[v], triangle_[side / 4]);
    normal_[v] = surface().smooth_normal(foot_[v].triangle, foot_[v].weights);
  }
}

Foot Result::foot(Index element, Index node) const {
  return foot_[node].triangle == kNone ? normals_.closest(after_.points[node], triangle_[element]) : foot_[node];
}

template <std::size_t N>
CornerNormals<N> Result::normals_at_nodes(Index element, const std::array<Index, N>& nodes) const {
  CornerNormals<N> normals{{}, Vector3d::Zero()};
  for (std::size_t i = 0; i < N; ++i)
    normals.whole += normals.at[i] =
        foot_[nodes[i]].triangle == kNone ? surface().normal_near(triangle_[element]) : normal_[nodes[i]];
  return normals;
}

template <std::size_t N>
bool Result::is_smooth_at(Index element, const std::array<Index, N>& nodes) const {
  return surface().is_smooth(triangle_[element]) && std::all_of(nodes.begin(), nodes.end(), [&](Index v) {
           return foot_[v].triangle == kNone || surface().is_smooth(foot_[v].triangle);
         });
}

template <std::size_t N>
std::array<double, N> Result::sines(Index element, const Corners<N>& p, const std::array<Index, N>& nodes) const {
  if (is_smooth_at(element, nodes)) {
    const CornerNormals<N> rough = normals_at_nodes(element, nodes);
    if (clear_jacobian(p, rough)) return corner_sines(p, rough);
  }
  return corner_sines(p, normals_.of(p, triangle_[element]));
}

template std::array<double, 3> Result::sines(Index, const Corners<3>&, const std::array<Index, 3>&) const;
template std::array<double, 4> Result::sines(Index, const Corners<4>&, const std::array<Index, 4>&) const;

}  // namespace qmorph::space
