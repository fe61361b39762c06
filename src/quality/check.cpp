// SPDX-License-Identifier: GPL-2.0-or-later
#include "qmorph/check.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

#include "geometry/describe.hpp"
#include "geometry/predicates.hpp"
#include "quality/judged.hpp"
#include "quality/shapes.hpp"
#include "quality/sides.hpp"
#include "space/faults.hpp"

namespace qmorph {
namespace {

using Edge = std::pair<Index, Index>;

/// Relative. Areas of a million elements add up with an error of about 1e-13; a hole of one element shows at 1e-7.
constexpr double kAreaTolerance = 1e-9;

using Finding = std::optional<Defect>;

/// `what` and where it is.
Defect at(const Eigen::Vector3d& place, const char* what) { return {what + (" at " + describe(place)), place}; }

/// Twice the area vector of a polygon, seen from its first corner.
template <std::size_t N>
Eigen::Vector3d area_vector(const std::vector<Eigen::Vector3d>& points, const std::array<Index, N>& element) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 1; k + 1 < N; ++k)
    sum += (points[element[k]] - points[element[0]]).cross(points[element[k + 1]] - points[element[0]]);
  return sum;
}

template <class Mesh>
Eigen::Vector3d area_vector(const Mesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& triangle : mesh.triangles) sum += area_vector(mesh.points, triangle);
  for (const auto& quad : mesh.quads) sum += area_vector(mesh.points, quad);
  return sum;
}

/// The same without direction: what leaves the plane has more of it.
template <class Mesh>
double twice_area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& triangle : mesh.triangles) sum += area_vector(mesh.points, triangle).norm();
  for (const auto& quad : mesh.quads) sum += area_vector(mesh.points, quad).norm();
  return sum;
}

/// The first corner of an element that is not convex, or N.
template <std::size_t N>
std::size_t bad_corner(const std::vector<Eigen::Vector3d>& points, const std::array<Index, N>& element,
                       const Eigen::Vector3d& normal) {
  for (std::size_t k = 0; k < N; ++k) {
    const Eigen::Vector3d& p = points[element[k]];
    const Eigen::Vector3d ahead = points[element[(k + 1) % N]] - p;
    const Eigen::Vector3d behind = points[element[(k + N - 1) % N]] - p;
    // The comparison is false for NaN, too.
    if (!(ahead.cross(behind).dot(normal) > kDegenerateSine * ahead.norm() * behind.norm())) return k;
  }
  return N;
}

template <std::size_t N>
Finding find_bad_corner(const QuadMesh& mesh, std::span<const std::array<Index, N>> elements,
                        const Eigen::Vector3d& normal) {
  for (const auto& element : elements)
    if (const std::size_t k = bad_corner(mesh.points, element, normal); k < N)
      return at(mesh.points[element[k]], "an element has a corner that is not convex");
  return {};
}

/// Where each point of the input is in the result, or kNone.
std::vector<Index> result_rows(const Patch& patch, const QuadMesh& mesh) {
  std::vector<Index> rows(patch.points.size(), kNone);
  for (Index i = 0; i < mesh.source.size(); ++i)
    if (mesh.source[i] != kNone) rows[mesh.source[i]] = i;
  return rows;
}

Finding find_bad_reference(const Patch& patch, const QuadMesh& mesh) {
  if (mesh.source.size() != mesh.points.size()) return Defect{"the result does not say where its nodes come from", {}};
  std::vector<bool> used(mesh.points.size(), false), taken(patch.points.size(), false);
  const auto use = [&](const auto& element) {
    for (Index i : element) {
      if (i >= used.size()) return false;
      used[i] = true;
    }
    return true;
  };
  if (!std::all_of(mesh.triangles.begin(), mesh.triangles.end(), use) ||
      !std::all_of(mesh.quads.begin(), mesh.quads.end(), use))
    return Defect{"an element of the result uses a node that does not exist", {}};
  for (Index i = 0; i < mesh.points.size(); ++i) {
    if (!used[i]) return at(mesh.points[i], "no element of the result uses its node");
    if (mesh.source[i] == kNone) continue;
    if (mesh.source[i] >= taken.size() || taken[mesh.source[i]])
      return at(mesh.points[i], "two nodes of the result have one origin");
    taken[mesh.source[i]] = true;
  }
  return {};
}

Finding find_moved_node(const Patch& patch, const QuadMesh& mesh, const std::vector<Index>& rows, Index node) {
  if (rows[node] == kNone) return at(patch.points[node], "a fixed node is gone");
  if (mesh.points[rows[node]] != patch.points[node]) return at(patch.points[node], "a fixed node has moved");
  return {};
}

/// Edges of the result in order, split into those with one element and those with two.
struct ResultEdges {
  std::vector<Edge> outer, inner;
  Finding defect;
};

Edge moved_edge(const std::vector<Index>& rows, Index a, Index b) {
  return {std::min(rows[a], rows[b]), std::max(rows[a], rows[b])};
}

/// More than two elements, or two on one side.
bool is_of_many(std::span<const Side> edge) {
  return edge.size() > 2 || (edge.size() == 2 && edge[0].forward == edge[1].forward);
}

/// `of_many`: edges where several sheets met before.
ResultEdges collect_edges(const QuadMesh& mesh, const std::vector<Edge>& of_many) {
  ResultEdges edges;
  for_each_edge(sorted_sides(mesh.points.size(), mesh.triangles, mesh.quads), [&](std::span<const Side> edge) {
    const Edge ends{edge[0].low, edge[0].high};
    (edge.size() == 1 ? edges.outer : edges.inner).push_back(ends);
    if (is_of_many(edge) && !std::binary_search(of_many.begin(), of_many.end(), ends))
      edges.defect = at(mesh.points[ends.first], "elements overlap");
  });
  return edges;
}

bool has(const std::vector<Edge>& edges, const Edge& edge) {
  return std::binary_search(edges.begin(), edges.end(), edge);
}

/// Boundary and constraint edges of the input, and the nodes that they hold in place.
Finding find_lost_edge(const Patch& patch, const QuadMesh& mesh, const std::vector<Index>& rows) {
  std::vector<Edge> outer, of_many;
  for_each_edge(sorted_sides(patch.points.size(), patch.triangles, patch.quads), [&](std::span<const Side> edge) {
    if (edge.size() == 1) outer.emplace_back(edge[0].low, edge[0].high);
    if (is_of_many(edge) && rows[edge[0].low] != kNone && rows[edge[0].high] != kNone)
      of_many.push_back(moved_edge(rows, edge[0].low, edge[0].high));
  });
  std::sort(of_many.begin(), of_many.end());
  const ResultEdges edges = collect_edges(mesh, of_many);
  if (edges.defect) return edges.defect;
  const auto check = [&](Index a, Index b, bool is_outer) -> Finding {
    for (Index node : {a, b})
      if (Finding moved = find_moved_node(patch, mesh, rows, node)) return moved;
    const Edge edge = moved_edge(rows, a, b);
    if (has(edges.outer, edge) || (!is_outer && has(edges.inner, edge))) return {};
    return Defect{std::string("the ") + (is_outer ? "boundary" : "constraint") + " edge from " +
                      describe(patch.points[a]) + " is gone",
                  patch.points[a]};
  };
  for (const auto& [a, b] : outer)
    if (Finding defect = check(a, b, true)) return defect;
  for (const auto& [a, b] : patch.constraints)
    if (Finding defect = check(a, b, false)) return defect;
  if (edges.outer.size() != outer.size()) return Defect{"the result has more boundary edges than the input", {}};
  return {};
}

Finding find_changed_quad(const Patch& patch, const QuadMesh& mesh, const std::vector<Index>& rows) {
  if (mesh.quads.size() < patch.quads.size()) return Defect{"a quad of the input is gone", {}};
  for (std::size_t q = 0; q < patch.quads.size(); ++q)
    for (std::size_t k = 0; k < 4; ++k) {
      if (Finding moved = find_moved_node(patch, mesh, rows, patch.quads[q][k])) return moved;
      if (mesh.quads[q][k] != rows[patch.quads[q][k]])
        return at(patch.points[patch.quads[q][k]], "a quad of the input has changed");
    }
  return {};
}

Defect area_defect(double factor) {
  std::ostringstream text;
  text.precision(9);
  text << "the area has changed by a factor of " << factor;
  return {text.str(), {}};
}

}  // namespace

Eigen::Vector3d mean_normal(const Patch& patch) { return area_vector(patch).normalized(); }

bool is_planar(const Patch& patch) { return plane_normal(patch).has_value(); }

std::optional<BadQuad> find_bad_quad(const Patch& patch) {
  if (patch.quads.empty()) return {};
  if (!is_planar(patch)) {
    Index corner = kNone;
    const Index quad = space::find_bad_quad(patch, corner);
    return quad == kNone ? std::nullopt : std::optional(BadQuad{quad, patch.points[corner]});
  }
  const Eigen::Vector3d normal = mean_normal(patch);
  for (Index q = 0; q < patch.quads.size(); ++q)
    if (const std::size_t k = bad_corner(patch.points, patch.quads[q], normal); k < 4)
      return BadQuad{q, patch.points[patch.quads[q][k]]};
  return {};
}

std::optional<Defect> find_defect(const Patch& patch, const QuadMesh& mesh, InputQuads quads, double beside) {
  Judged judged(patch, mesh);
  return find_defect(judged, quads, beside);
}

std::optional<Defect> find_defect(Judged& judged, InputQuads quads, double beside) {
  const Patch& patch = judged.before();
  const QuadMesh& mesh = judged.after();
  if (Finding defect = find_bad_reference(patch, mesh)) return defect;
  const std::vector<Index> rows = result_rows(patch, mesh);
  for (Index node : patch.fixed)
    if (Finding defect = find_moved_node(patch, mesh, rows, node)) return defect;
  if (Finding defect = find_lost_edge(patch, mesh, rows)) return defect;
  const bool kept = quads == InputQuads::kept;
  if (kept)
    if (Finding defect = find_changed_quad(patch, mesh, rows)) return defect;

  if (!judged.plane()) return space::find_defect(patch, judged.on_surface(), kept ? patch.quads.size() : 0, beside);
  const Eigen::Vector3d normal = mean_normal(patch);
  // Quads that were there before are looked at by find_bad_quad.
  const auto made = std::span<const std::array<Index, 4>>(mesh.quads).subspan(kept ? patch.quads.size() : 0);
  if (Finding bad = find_bad_corner<4>(mesh, made, normal)) return bad;
  if (Finding bad = find_bad_corner<3>(mesh, mesh.triangles, normal)) return bad;
  // Quads that are free to change may be turned over in the input.
  const double before = kept ? twice_area(patch) : area_vector(patch).norm(), after = twice_area(mesh);
  if (!(std::abs(after - before) <= kAreaTolerance * before)) return area_defect(after / before);
  return {};
}

}  // namespace qmorph
