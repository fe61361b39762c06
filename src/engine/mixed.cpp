// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/mixed.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_set>

#include "engine/prepare.hpp"
#include "geometry/predicates.hpp"
#include "kernel/sort_unique.hpp"
#include "qmorph/error.hpp"
#include "smoothing/smooth.hpp"
#include "topology/edits.hpp"

namespace qmorph {
namespace {

using kernel::Mesh;

Eigen::Vector3d area_vector(const Patch& patch, Index a, Index b, Index c) {
  return (patch.points[b] - patch.points[a]).cross(patch.points[c] - patch.points[a]);
}

Eigen::Vector3d mean_normal(const Patch& patch) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& t : patch.triangles) sum += area_vector(patch, t[0], t[1], t[2]);
  for (const auto& q : patch.quads) sum += area_vector(patch, q[0], q[1], q[2]) + area_vector(patch, q[0], q[2], q[3]);
  return sum;
}

/// Pairs of nodes that have an edge.
class Edges {
 public:
  Edges() = default;
  explicit Edges(const Patch& patch) {
    const auto add_sides = [&](const auto& element) {
      for (std::size_t i = 0; i < element.size(); ++i) add(element[i], element[(i + 1) % element.size()]);
    };
    for (const auto& t : patch.triangles) add_sides(t);
    for (const auto& q : patch.quads) add_sides(q);
  }
  void add(Index a, Index b) { keys_.insert(key(a, b)); }
  bool has(Index a, Index b) const { return keys_.count(key(a, b)) != 0; }

 private:
  static std::uint64_t key(Index a, Index b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }
  std::unordered_set<std::uint64_t> keys_;
};

bool is_bad(const Mesh& mesh, Index f) { return mesh.is_live_face(f) && !mesh.is_valid_face(f); }

/// Bad elements in sets that are not farther apart than what untangling moves around them; all nodes of each set.
std::vector<std::vector<Index>> find_bad_sets(const Mesh& mesh) {
  constexpr int kReach = 3;
  std::vector<char> seen(mesh.face_slots(), 0);
  std::vector<std::vector<Index>> sets;
  for (Index first = 0; first < mesh.face_slots(); ++first) {
    if (seen[first] || !is_bad(mesh, first)) continue;
    std::vector<Index> open{first}, nodes;
    seen[first] = 1;
    while (!open.empty()) {
      const Index f = open.back();
      open.pop_back();
      for (Index v : topology::nodes_of(mesh, f)) nodes.push_back(v);
      for (Index g : topology::grow(mesh, {f}, kReach))
        if (!seen[g] && is_bad(mesh, g)) {
          seen[g] = 1;
          open.push_back(g);
        }
    }
    sort_unique(nodes);
    sets.push_back(std::move(nodes));
  }
  return sets;
}

/// Moves each free node to the middle of its neighbours, a few times over: not a solution, but a good start.
void spread(Mesh& mesh, const std::vector<Index>& nodes) {
  constexpr int kPasses = 20;
  for (int pass = 0; pass < kPasses; ++pass)
    for (Index v : nodes)
      if (mesh.is_free(v)) mesh.set_point(v, topology::middle_of_neighbours(mesh, v));
}

/// How hard to try: where the nodes start, how far around others move, how often.
struct Effort {
  bool from_the_middle;
  int rings;
  int sweeps;  ///< times the usual number
};
constexpr Effort kEfforts[] = {{false, 2, 1}, {true, 2, 1}, {true, 4, 4}};

void untangle_bad_sets(Mesh& mesh, const SmoothingOptions& smoothing) {
  for (const std::vector<Index>& nodes : find_bad_sets(mesh))
    for (const Effort& effort : kEfforts) {
      SmoothingOptions options = smoothing;
      options.untangling_sweeps *= effort.sweeps;
      mesh.begin();
      if (effort.from_the_middle) spread(mesh, nodes);
      const bool done = smoothing::smooth_near(mesh, options, nodes, effort.rings);
      done ? mesh.commit() : mesh.rollback();
      if (done) break;
    }
}

/// Cuts a quad along the diagonal whose triangles are better, good or bad. Not along one that is an edge already.
void cut(Mesh& mesh, Index f) {
  const std::vector<Index> n = topology::nodes_of(mesh, f);
  const auto worth = [&](int k) {
    if (mesh.find(n[k], n[k + 2]) != kNone) return -2.0;
    return std::min(topology::smallest_sine(mesh, {n[k], n[k + 1], n[k + 2]}),
                    topology::smallest_sine(mesh, {n[k], n[k + 2], n[(k + 3) % 4]}));
  };
  const double first = worth(0), second = worth(1);
  if (std::max(first, second) < -1) return;
  Index h = mesh.half_edge(f);
  if (second > first) h = mesh.next(h);
  mesh.split_face(h, mesh.next(mesh.next(h)));
}

}  // namespace

Patch cut_quads(const Patch& patch) {
  Patch result = patch;
  result.quads.clear();
  result.triangles.reserve(patch.triangles.size() + 2 * patch.quads.size());
  const Eigen::Vector3d normal = mean_normal(patch);
  const auto smaller_half = [&](const std::array<Index, 4>& q, int k) {
    return std::min(area_vector(patch, q[k], q[k + 1], q[k + 2]).dot(normal),
                    area_vector(patch, q[k], q[k + 2], q[(k + 3) % 4]).dot(normal));
  };
  // In a mesh without folds no diagonal can be the edge of another element.
  const bool folded = std::any_of(patch.quads.begin(), patch.quads.end(), [&](const std::array<Index, 4>& q) {
    return !(std::max(smaller_half(q, 0), smaller_half(q, 1)) > 0);
  });
  Edges edges = folded ? Edges(patch) : Edges(), lines;
  for (const auto& [a, b] : patch.constraints) lines.add(a, b);
  for (const auto& q : patch.quads) {
    int k = smaller_half(q, 1) > smaller_half(q, 0) ? 1 : 0;
    if (lines.has(q[1 - k], q[3 - k]) && !lines.has(q[k], q[k + 2]) && smaller_half(q, 1 - k) > 0) k = 1 - k;
    if (folded && edges.has(q[k], q[k + 2]) && !edges.has(q[1 - k], q[3 - k])) k = 1 - k;
    if (folded) edges.add(q[k], q[k + 2]);
    result.triangles.push_back({q[k], q[k + 1], q[k + 2]});
    result.triangles.push_back({q[k], q[k + 2], q[(k + 3) % 4]});
  }
  return result;
}

Mesh join_halves(const Region& region, std::size_t triangles) {
  Mesh mesh(region.points, region.triangles, region.open);
  for (Index v : region.fixed) mesh.set_fixed(v);
  // The halves of a quad are rows that follow one another. They are in two regions where a constraint runs along the
  // diagonal, and then they stay halves.
  std::vector<std::pair<Index, Index>> halves;  // row, face
  for (Index f = 0; f < region.row.size(); ++f)
    if (region.row[f] >= triangles) halves.emplace_back(region.row[f], f);
  std::sort(halves.begin(), halves.end());
  for (std::size_t i = 0; i + 1 < halves.size(); ++i) {
    const auto [row, f] = halves[i];
    if ((row - triangles) % 2 != 0 || halves[i + 1].first != row + 1) continue;
    Index h = mesh.half_edge(f);
    for (int k = 0; k < 3 && mesh.target(h) != region.triangles[f][0]; ++k) h = mesh.next(h);
    if (mesh.face(Mesh::twin(h)) == halves[i + 1].second) mesh.join_faces(h);
  }
  return mesh;
}

void take_triangles(const Mesh& mesh, Region& region) {
  region.triangles.clear();
  region.row.clear();
  region.open.clear();
  for (Index v = 0; v < region.points.size(); ++v)
    if (mesh.is_live_vertex(v)) region.points[v] = mesh.point(v);
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    const Index h = mesh.half_edge(f), after = mesh.next(h), before = mesh.prev(h);
    const bool is_quad = mesh.is_quad(f);
    region.triangles.push_back({mesh.origin(h), mesh.target(h), mesh.target(after)});
    region.open.push_back(mesh.is_boundary_edge(h));
    region.open.push_back(mesh.is_boundary_edge(after));
    region.open.push_back(!is_quad && mesh.is_boundary_edge(before));
    if (!is_quad) continue;
    region.triangles.push_back({mesh.origin(h), mesh.target(after), mesh.origin(before)});
    region.open.push_back(false);
    region.open.push_back(mesh.is_boundary_edge(mesh.next(after)));
    region.open.push_back(mesh.is_boundary_edge(before));
  }
}

void mend_quads(Mesh& mesh, const SmoothingOptions& smoothing, const Plane& plane) {
  std::vector<Index> nodes;
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v)) nodes.push_back(v);
  topology::remove_doublets(mesh, nodes);
  untangle_bad_sets(mesh, smoothing);
  const Index faces = mesh.face_slots();
  for (Index f = 0; f < faces; ++f)
    if (mesh.is_quad(f) && is_bad(mesh, f)) cut(mesh, f);
  untangle_bad_sets(mesh, smoothing);  // triangles are satisfied more easily
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (is_bad(mesh, f) && (mesh.is_quad(f) || mesh.smallest_sine(f) < -kDegenerateSine))
      throw SurfaceError(
          "the element " + corners_of(mesh, plane, f) +
              " is turned over, and no place was found for its nodes where it is not; mesh the surface anew or "
              "repair it",
          {.kind = ErrorKind::bad_element, .place = corner_of(mesh, plane, f)});
}

}  // namespace qmorph
