#include "engine/mixed.hpp"

#include <algorithm>

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

/// Valid or not, a mesh has few bad elements: sets of those that share nodes, with all their nodes.
std::vector<std::vector<Index>> nodes_of_bad_quads(const Mesh& mesh) {
  const auto is_bad = [&](Index f) { return mesh.is_quad(f) && !mesh.is_valid_face(f); };
  std::vector<char> seen(mesh.face_slots(), 0);
  std::vector<std::vector<Index>> sets;
  for (Index first = 0; first < mesh.face_slots(); ++first) {
    if (!mesh.is_live_face(first) || seen[first] || !is_bad(first)) continue;
    std::vector<Index> open{first}, nodes;
    seen[first] = 1;
    while (!open.empty()) {
      const Index f = open.back();
      open.pop_back();
      for (Index v : topology::nodes_of(mesh, f)) nodes.push_back(v);
      for (Index g : topology::grow(mesh, {f}, 1))
        if (!seen[g] && is_bad(g)) {
          seen[g] = 1;
          open.push_back(g);
        }
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    sets.push_back(std::move(nodes));
  }
  return sets;
}

void untangle(Mesh& mesh, const SmoothingOptions& smoothing, const std::vector<Index>& nodes) {
  constexpr int kRings = 2;
  mesh.begin();
  smoothing::smooth_near(mesh, smoothing, nodes, kRings) ? mesh.commit() : mesh.rollback();
}

/// Cuts a quad along the diagonal whose triangles are better. False if one of them is not valid all the same.
bool cut(Mesh& mesh, Index f) {
  const std::vector<Index> n = topology::nodes_of(mesh, f);
  const auto worth = [&](int k) {
    return std::min(topology::smallest_sine(mesh, {n[k], n[k + 1], n[k + 2]}),
                    topology::smallest_sine(mesh, {n[k], n[k + 2], n[(k + 3) % 4]}));
  };
  Index h = mesh.half_edge(f);
  if (worth(1) > worth(0)) h = mesh.next(h);
  const Index diagonal = mesh.split_face(h, mesh.next(mesh.next(h)));
  return mesh.is_valid_face(mesh.face(diagonal)) && mesh.is_valid_face(mesh.face(Mesh::twin(diagonal)));
}

std::string corners_of(const Mesh& mesh, const Plane& plane, Index f) {
  std::string text;
  for (Index v : topology::nodes_of(mesh, f))
    text += (text.empty() ? "" : ", ") + describe(plane.to_space(mesh.point(v)));
  return text;
}

}  // namespace

Patch cut_quads(const Patch& patch) {
  Patch result = patch;
  result.quads.clear();
  result.triangles.reserve(patch.triangles.size() + 2 * patch.quads.size());
  const Eigen::Vector3d normal = mean_normal(patch);
  for (const auto& q : patch.quads) {
    const auto smaller_half = [&](int k) {
      return std::min(area_vector(patch, q[k], q[k + 1], q[k + 2]).dot(normal),
                      area_vector(patch, q[k], q[k + 2], q[(k + 3) % 4]).dot(normal));
    };
    const int k = smaller_half(1) > smaller_half(0) ? 1 : 0;
    result.triangles.push_back({q[k], q[k + 1], q[k + 2]});
    result.triangles.push_back({q[k], q[k + 2], q[(k + 3) % 4]});
  }
  return result;
}

Mesh join_halves(const Region& region, std::size_t triangles) {
  Mesh mesh(region.points, region.triangles, region.open);
  for (Index v : region.fixed) mesh.set_fixed(v);
  // The halves of a quad follow one another, and faces are numbered as the triangles are. They are in two regions where a
  // constraint runs along the diagonal, and then they stay halves.
  const auto is_first_half = [&](Index f) {
    return region.row[f] >= triangles && (region.row[f] - triangles) % 2 == 0;
  };
  for (Index f = 0; f + 1 < region.row.size(); ++f) {
    if (!is_first_half(f) || region.row[f + 1] != region.row[f] + 1) continue;
    Index h = mesh.half_edge(f);
    for (int i = 0; i < 3 && mesh.target(h) != region.triangles[f][0]; ++i) h = mesh.next(h);
    if (mesh.face(Mesh::twin(h)) == f + 1) mesh.join_faces(h);
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
  for (const std::vector<Index>& bad : nodes_of_bad_quads(mesh)) untangle(mesh, smoothing, bad);
  const Index faces = mesh.face_slots();
  for (Index f = 0; f < faces; ++f) {
    if (!mesh.is_live_face(f) || !mesh.is_quad(f) || mesh.is_valid_face(f)) continue;
    const std::string corners = corners_of(mesh, plane, f);
    if (!cut(mesh, f))
      throw SurfaceError("the quad " + corners +
                         " is turned over, and no place was found for its nodes where it is not; "
                         "mesh the surface anew or repair it");
  }
}

}  // namespace qmorph
