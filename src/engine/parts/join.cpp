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

PartElements::PartElements(const std::vector<Index>& node, const Mesh& mesh) {
  std::vector<Index> row(mesh.vertex_slots(), kNone);
  for (Index v = 0; v < mesh.vertex_slots(); ++v) {
    if (!mesh.is_live_vertex(v)) continue;
    row[v] = Index(points.size());
    points.push_back(mesh.point(v));
    vertex.push_back(v < node.size() ? node[v] : kNone);
  }
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    std::array<Index, 4> face{kNone, kNone, kNone, kNone};
    Index h = mesh.half_edge(f);
    for (Index i = 0; i < mesh.degree(f); ++i, h = mesh.next(h)) {
      face[i] = row[mesh.origin(h)];
      boundary.push_back(mesh.is_boundary_edge(h));
    }
    faces.push_back(face);
    boundary.resize(4 * faces.size(), false);
  }
}

Mesh join(const Whole& whole, const std::vector<PartElements>& parts) {
  std::vector<Vec2> points = whole.points;
  std::vector<std::array<Index, 4>> faces;
  std::vector<bool> open;
  const auto is_interface = [&](Index a, Index b) {
    return std::binary_search(whole.interface_edges.begin(), whole.interface_edges.end(), edge_of(a, b));
  };
  for (const PartElements& part : parts) {
    std::vector<Index> vertex = part.vertex;
    for (std::size_t i = 0; i < vertex.size(); ++i) {
      if (vertex[i] == kNone) vertex[i] = Index(points.size()), points.emplace_back();
      points[vertex[i]] = part.points[i];
    }
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
      std::array<Index, 4> face = part.faces[f];
      const std::size_t degree = face[3] == kNone ? 3 : 4;
      for (std::size_t i = 0; i < degree; ++i) face[i] = vertex[face[i]];
      for (std::size_t i = 0; i < 4; ++i)
        open.push_back(part.boundary[4 * f + i] && !is_interface(face[i], face[(i + 1) % degree]));
      faces.push_back(face);
    }
  }
  Mesh mesh(points, faces, open);
  for (Index v : whole.fixed) mesh.set_fixed(v);
  return mesh;
}

}  // namespace qmorph
