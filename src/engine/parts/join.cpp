#include "engine/parts/join.hpp"

#include <algorithm>

namespace qmorph {
namespace {

using kernel::Mesh;

/// Gives the vertices of parts numbers: one for each fan of the part's triangles at a node.
class Fans {
 public:
  Fans(const Mesh& mesh, const Division& division)
      : mesh_(mesh), division_(division), vertex_(mesh.half_edge_slots(), kNone) {}

  /// The vertex at origin(h) of the part that h belongs to.
  Index vertex_at(Index h, Region& region) {
    if (vertex_[h] != kNone) return vertex_[h];
    const auto vertex = Index(region.points.size());
    const Index v = mesh_.origin(h);
    region.points.push_back(mesh_.point(v));
    region.node.push_back(v);
    if (mesh_.is_fixed(v)) region.fixed.push_back(vertex);
    Index e = h;
    do {
      vertex_[e] = vertex;
      if (!is_inside(mesh_.prev(e))) break;
      e = mesh_.rotate_ccw(e);
    } while (e != h);
    for (e = h; is_inside(e);) {
      e = mesh_.rotate_cw(e);
      if (vertex_[e] == vertex) break;
      vertex_[e] = vertex;
    }
    return vertex;
  }

  bool is_inside(Index h) const { return !mesh_.is_boundary_edge(h) && !division_.is_interface(mesh_, h); }

 private:
  const Mesh& mesh_;
  const Division& division_;
  std::vector<Index> vertex_;  ///< by half-edge
};

std::pair<Index, Index> edge_of(Index a, Index b) { return std::minmax(a, b); }

}  // namespace

std::vector<Region> take_apart(const Mesh& mesh, const Division& division) {
  std::vector<Region> regions(division.parts);
  Fans fans(mesh, division);
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    Region& region = regions[division.part[f]];
    std::array<Index, 3> corners{};
    Index h = mesh.half_edge(f);
    for (Index& corner : corners) {
      corner = fans.vertex_at(h, region);
      region.open.push_back(!fans.is_inside(h));
      region.boundary_sides += region.open.back();
      h = mesh.next(h);
    }
    region.triangles.push_back(corners);
  }
  return regions;
}

Whole::Whole(const Mesh& mesh, const Division& division) {
  for (Index v = 0; v < mesh.vertex_slots(); ++v) {
    points.push_back(mesh.point(v));
    if (mesh.is_live_vertex(v) && mesh.is_fixed(v)) fixed.push_back(v);
  }
  for (Index h = 0; h < mesh.half_edge_slots(); h += 2)
    if (mesh.is_live_half_edge(h) && division.is_interface(mesh, h))
      interface_edges.push_back(edge_of(mesh.origin(h), mesh.target(h)));
  std::sort(interface_edges.begin(), interface_edges.end());
}

Mesh join(const Whole& whole, const std::vector<Region>& parts, const std::vector<const Mesh*>& meshes) {
  std::vector<Vec2> points = whole.points;
  std::vector<std::array<Index, 4>> faces;
  std::vector<bool> open;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Mesh& mesh = *meshes[i];
    std::vector<Index> vertex = parts[i].node;
    vertex.resize(mesh.vertex_slots(), kNone);
    for (Index v = 0; v < mesh.vertex_slots(); ++v) {
      if (!mesh.is_live_vertex(v)) continue;
      if (vertex[v] == kNone) vertex[v] = Index(points.size()), points.emplace_back();
      points[vertex[v]] = mesh.point(v);
    }
    const auto is_interface = [&](Index h) {
      const auto edge = edge_of(vertex[mesh.origin(h)], vertex[mesh.target(h)]);
      return std::binary_search(whole.interface_edges.begin(), whole.interface_edges.end(), edge);
    };
    for (Index f = 0; f < mesh.face_slots(); ++f) {
      if (!mesh.is_live_face(f)) continue;
      auto& face = faces.emplace_back();
      face[3] = kNone;
      Index h = mesh.half_edge(f);
      for (Index k = 0; k < mesh.degree(f); ++k, h = mesh.next(h)) {
        face[k] = vertex[mesh.origin(h)];
        open.push_back(mesh.is_boundary_edge(h) && !is_interface(h));
      }
      open.resize(4 * faces.size(), false);
    }
  }
  Mesh mesh(points, faces, open);
  for (Index v : whole.fixed) mesh.set_fixed(v);
  return mesh;
}

}  // namespace qmorph
