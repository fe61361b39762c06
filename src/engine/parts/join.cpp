// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/parts/join.hpp"

#include <algorithm>
#include <unordered_map>

#include "parallel/for_each.hpp"

namespace qmorph {
namespace {

using kernel::Mesh;

/// Gives the vertices of parts numbers: one for each fan of the part's triangles at a node. Parts may be worked on side
/// by side.
class Fans {
 public:
  Fans(const Mesh& mesh, const Division& division)
      : mesh_(mesh), division_(division), inner_(mesh.vertex_slots(), kNone), on_interface_(inner_.size(), false) {
    for (Index v : division.interface) on_interface_[v] = true;
  }

  bool is_inside(Index h) const { return !mesh_.is_boundary_edge(h) && !division_.is_interface(mesh_, h); }

  /// All triangles at v belong to one part, in one fan.
  bool is_inner(Index v) const { return !mesh_.is_boundary(v) && !on_interface_[v]; }
  /// The vertex of the part at an inner node; kNone at first.
  Index& vertex_at(Index v) { return inner_[v]; }

  /// The first half-edge, counter-clockwise, of a fan at a node that is not inner.
  Index first_of_fan(Index h) const {
    while (is_inside(h)) h = mesh_.rotate_cw(h);
    return h;
  }

 private:
  const Mesh& mesh_;
  const Division& division_;
  std::vector<Index> inner_;  ///< by node
  std::vector<bool> on_interface_;
};

Region region_of(const Mesh& mesh, Fans& fans, const std::vector<Index>& faces) {
  Region region;
  region.triangles.reserve(faces.size());
  region.open.assign(3 * faces.size(), false);
  std::unordered_map<Index, Index> outer;  // vertices at nodes that are not inner, by the first half-edge of the fan
  const auto vertex_at = [&](Index h) {
    const Index v = mesh.origin(h);
    Index* vertex = &fans.vertex_at(v);
    if (*vertex == kNone && !fans.is_inner(v)) vertex = &outer.try_emplace(fans.first_of_fan(h), kNone).first->second;
    if (*vertex == kNone) {
      *vertex = Index(region.node.size());
      region.node.push_back(v);
      if (mesh.is_fixed(v)) region.fixed.push_back(*vertex);
    }
    return *vertex;
  };
  for (Index f : faces) {
    std::array<Index, 3> corners{};
    Index h = mesh.half_edge(f);
    for (Index i = 0; i < 3; ++i, h = mesh.next(h)) {
      corners[i] = vertex_at(h);
      if (!fans.is_inside(h)) region.open[3 * region.triangles.size() + i] = true, ++region.boundary_sides;
    }
    region.triangles.push_back(corners);
  }
  region.points.reserve(region.node.size());
  for (Index v : region.node) region.points.push_back(mesh.point(v));
  return region;
}

/// The order of the faces by their lowest corner: what lies close together in the points does so in the faces. A
/// counting sort.
std::vector<Index> order_by_lowest(const std::vector<std::array<Index, 4>>& faces, std::size_t points) {
  std::vector<Index> start(points + 1, 0), order(faces.size());
  const auto lowest = [](const auto& face) { return *std::min_element(face.begin(), face.end()); };
  for (const auto& face : faces) ++start[lowest(face) + 1];
  for (std::size_t v = 0; v < points; ++v) start[v + 1] += start[v];
  for (Index f = 0; f < faces.size(); ++f) order[start[lowest(faces[f])]++] = f;
  return order;
}

}  // namespace

std::vector<Region> take_apart(const Mesh& mesh, const Division& division) {
  std::vector<std::vector<Index>> faces(division.parts);
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f)) faces[division.part[f]].push_back(f);
  std::vector<Region> regions(division.parts);
  Fans fans(mesh, division);
  parallel::for_each_index(regions.size(),
                           [&](std::size_t part) { regions[part] = region_of(mesh, fans, faces[part]); });
  return regions;
}

Whole::Whole(const Mesh& mesh, const Division& division) {
  points.reserve(mesh.vertex_slots());
  for (Index v = 0; v < mesh.vertex_slots(); ++v) {
    points.push_back(mesh.point(v));
    if (mesh.is_live_vertex(v) && mesh.is_fixed(v)) fixed.push_back(v);
  }
  for (Index v : division.interface) {
    for (Index h : mesh.around(v))
      if (v < mesh.target(h) && division.is_interface(mesh, h)) interface_edges.emplace_back(v, mesh.target(h));
  }
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
  std::vector<std::array<Index, 4>> unsorted;
  std::vector<Index> slot;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    std::array<Index, 4> face{kNone, kNone, kNone, kNone};
    Index h = mesh.half_edge(f);
    for (Index i = 0; i < mesh.degree(f); ++i, h = mesh.next(h)) face[i] = row[mesh.origin(h)];
    unsorted.push_back(face);
    slot.push_back(f);
  }
  faces.reserve(unsorted.size());
  for (Index k : order_by_lowest(unsorted, points.size())) {
    Index h = mesh.half_edge(slot[k]);
    for (Index i = 0; i < mesh.degree(slot[k]); ++i, h = mesh.next(h))
      if (mesh.is_boundary_edge(h)) boundary.push_back(4 * faces.size() + i);
    faces.push_back(unsorted[k]);
  }
}

Mesh join(Whole whole, std::vector<PartElements> parts) {
  std::vector<Vec2> points = std::move(whole.points);
  std::vector<std::array<Index, 4>> faces;
  std::size_t count = 0, new_points = 0;
  for (const PartElements& part : parts) {
    count += part.faces.size();
    new_points += std::size_t(std::count(part.vertex.begin(), part.vertex.end(), kNone));
  }
  points.reserve(points.size() + new_points);
  faces.reserve(count);
  std::vector<bool> open(4 * count, false);
  for (PartElements& part : parts) {
    std::vector<Index> vertex = std::move(part.vertex);
    for (std::size_t i = 0; i < vertex.size(); ++i) {
      if (vertex[i] == kNone) vertex[i] = Index(points.size()), points.emplace_back();
      points[vertex[i]] = part.points[i];
    }
    for (std::size_t side : part.boundary) {
      const auto& face = part.faces[side / 4];
      const std::size_t i = side % 4, next = i == 3 || face[i + 1] == kNone ? 0 : i + 1;
      const std::pair<Index, Index> edge = std::minmax(vertex[face[i]], vertex[face[next]]);
      if (!std::binary_search(whole.interface_edges.begin(), whole.interface_edges.end(), edge))
        open[4 * faces.size() + side] = true;
    }
    for (std::array<Index, 4> face : part.faces) {
      for (Index& corner : face)
        if (corner != kNone) corner = vertex[corner];
      faces.push_back(face);
    }
    part = {};
  }
  Mesh mesh(points, faces, open);
  for (Index v : whole.fixed) mesh.set_fixed(v);
  return mesh;
}

}  // namespace qmorph
