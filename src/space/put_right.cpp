// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/put_right.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include "kernel/is_any.hpp"
#include "space/element_sides.hpp"
#include "space/faults.hpp"
#include "space/mesh_normals.hpp"
#include "space/result.hpp"

namespace qmorph::space {
namespace {

using Eigen::Vector3d;

/// Of elements that are doubtful an edge does not tell whether it is a crease.
class Spreading {
 public:
  Spreading(const Patch& patch, const std::vector<char>& doubtful, std::size_t kept, double crease_angle)
      : patch_(patch),
        sides_(patch.points.size(), patch.triangles, patch.quads, patch.constraints),
        normals_(patch.points, sides_),
        is_free_(patch.points.size(), 1),
        neighbours_(patch.points.size()) {
    for (Index v : patch.fixed) is_free_[v] = 0;
    for (std::size_t q = 0; q < kept; ++q)
      for (Index v : patch.quads[q]) is_free_[v] = 0;
    for (Index side = 0; side < sides_.slots(); ++side) {
      if (sides_.node(side) == kNone) continue;
      const Index a = sides_.node(side), b = sides_.target(side);
      neighbours_[a].push_back(b);
      if (is_held(side, doubtful, std::cos(crease_angle))) is_free_[a] = is_free_[b] = 0;
    }
  }

  /// With nodes of the elements that are marked and of those some rings around.
  Patch run(std::vector<char> elements, int rings) const {
    constexpr int kPasses = 40;
    std::vector<Index> nodes = nodes_around(std::move(elements), rings);
    Patch moved = patch_;
    for (int pass = 0; pass < kPasses; ++pass)
      for (Index v : nodes) {
        Vector3d sum = Vector3d::Zero();
        for (Index other : neighbours_[v]) sum += moved.points[other];
        moved.points[v] = sum / double(neighbours_[v].size());
      }
    QuadMesh mesh{moved.points, std::vector<Index>(moved.points.size()), patch_.triangles, patch_.quads};
    std::iota(mesh.source.begin(), mesh.source.end(), Index(0));
    lay_onto(patch_, mesh);
    moved.points = std::move(mesh.points);
    return moved;
  }

 private:
  /// Not inside, or along a crease.
  bool is_held(Index side, const std::vector<char>& doubtful, double least_cosine) const {
    const Index opposite = sides_.opposite(side);
    if (opposite == kNone) return true;
    if (doubtful[side / 4] || doubtful[opposite / 4]) return false;
    return normals_.own(side / 4).dot(normals_.own(opposite / 4)) < least_cosine;
  }

  /// Those that are free, in their order.
  std::vector<Index> nodes_around(std::vector<char> elements, int rings) const {
    std::vector<char> is_near(patch_.points.size(), 0);
    for (int ring = 0; ring <= rings; ++ring) {
      for (Index side = 0; side < sides_.slots(); ++side)
        if (elements[side / 4] && sides_.node(side) != kNone) is_near[sides_.node(side)] = 1;
      for (Index side = 0; side < sides_.slots(); ++side)
        if (sides_.node(side) != kNone && is_near[sides_.node(side)]) elements[side / 4] = 1;
    }
    std::vector<Index> nodes;
    for (Index v = 0; v < is_near.size(); ++v)
      if (is_near[v] && is_free_[v]) nodes.push_back(v);
    return nodes;
  }

  const Patch& patch_;
  const ElementSides sides_;
  const MeshNormals normals_;
  std::vector<char> is_free_;
  std::vector<std::vector<Index>> neighbours_;  ///< by node; of free ones, each once
};

/// Marks elements that share a node with those that are marked, besides.
std::vector<char> with_neighbours(const Patch& patch, std::vector<char> marked) {
  std::vector<char> is_touched(patch.points.size(), 0);
  const std::size_t triangles = patch.triangles.size();
  const auto for_each_node = [&](std::size_t element, const auto& look) {
    if (element < triangles)
      for (const Index v : patch.triangles[element]) look(v);
    else
      for (const Index v : patch.quads[element - triangles]) look(v);
  };
  for (std::size_t e = 0; e < marked.size(); ++e)
    if (marked[e]) for_each_node(e, [&](Index v) { is_touched[v] = 1; });
  for (std::size_t e = 0; e < marked.size(); ++e) for_each_node(e, [&](Index v) { marked[e] |= is_touched[v]; });
  return marked;
}

}  // namespace

std::optional<Patch> put_right(const Patch& patch, std::size_t kept, double crease_angle) {
  const std::vector<char> bad = bad_elements(patch);
  if (!is_any(bad)) return {};
  // Where triangles are coarse, a node that is out of place makes sharp edges between good elements around it, too.
  for (const std::vector<char>& doubtful : {bad, with_neighbours(patch, bad)}) {
    const Spreading spreading(patch, doubtful, kept, crease_angle);
    for (const int rings : {0, 1, 3})
      if (Patch moved = spreading.run(bad, rings); !is_any(bad_elements(moved))) return moved;
  }
  return {};
}

void lay_onto(const Patch& patch, QuadMesh& mesh) {
  std::vector<Vector3d> points = mesh.points;
  const Result result(patch, mesh);
  for (Index v = 0; v < points.size(); ++v) {
    const Index row = mesh.source[v];
    const bool stays = row != kNone && patch.points[row] == points[v];
    if (!stays && result.foot(v).triangle != kNone) points[v] = result.foot(v).point;
  }
  mesh.points = std::move(points);
}

}  // namespace qmorph::space
