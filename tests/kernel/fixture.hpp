// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Small meshes for tests of the kernel and of everything above it, and what can be said about any mesh.

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "kernel/mesh.hpp"
#include "support/rng.hpp"

namespace qmorph::test {

using kernel::Mesh;
using Polygons = std::vector<std::vector<Index>>;
using Edges = std::vector<std::pair<Index, Index>>;

/// The half-edge from a to b, which must be there.
inline Index edge(const Mesh& mesh, Index a, Index b) {
  const Index h = mesh.find(a, b);
  if (h == kNone) throw std::logic_error("no edge " + std::to_string(a) + "-" + std::to_string(b));
  return h;
}

/// A mesh of triangles and quads. A quad is two triangles that meet at its first corner, joined: where two quads
/// share two edges, start both at the node in the middle.
inline Mesh drawn(const std::vector<Vec2>& points, const Polygons& polygons) {
  std::vector<std::array<Index, 3>> triangles;
  for (const auto& p : polygons) {
    triangles.push_back({p[0], p[1], p[2]});
    if (p.size() == 4) triangles.push_back({p[0], p[2], p[3]});
  }
  Mesh mesh(points, triangles);
  for (Index f = 0; const auto& p : polygons) {
    if (p.size() == 4) {
      Index h = mesh.half_edge(f);  // of the first triangle
      while (mesh.origin(h) != p[2]) h = mesh.next(h);
      mesh.join_faces(h);
    }
    f += Index(p.size()) - 2;
  }
  return mesh;
}

/// Every face as its nodes counter-clockwise from the smallest, in order: equal exactly if the meshes are the same but
/// for the numbers of half-edges and faces.
inline Polygons faces_of(const Mesh& mesh) {
  Polygons faces;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    std::vector<Index> nodes;
    Index h = mesh.half_edge(f);
    for (Index i = 0; i < mesh.degree(f); ++i, h = mesh.next(h)) nodes.push_back(mesh.origin(h));
    std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end()), nodes.end());
    faces.push_back(nodes);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// Edges with the outside on their right, sorted.
inline Edges boundary_of(const Mesh& mesh) {
  Edges edges;
  for (Index h = 0; h < mesh.half_edge_slots(); ++h)
    if (mesh.is_live_half_edge(h) && mesh.face(h) == kNone) edges.emplace_back(mesh.target(h), mesh.origin(h));
  std::sort(edges.begin(), edges.end());
  return edges;
}

inline int count_faces(const Mesh& mesh, Index degree) {
  int count = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f) count += mesh.is_live_face(f) && mesh.degree(f) == degree;
  return count;
}
inline int count_triangles(const Mesh& mesh) { return count_faces(mesh, 3); }
inline int count_quads(const Mesh& mesh) { return count_faces(mesh, 4); }

struct Counts {
  int nodes = 0, edges = 0, faces = 0;
  int euler() const { return nodes - edges + faces; }
  bool operator==(const Counts&) const = default;
};
inline std::ostream& operator<<(std::ostream& out, const Counts& c) {
  return out << c.nodes << " nodes, " << c.edges << " edges, " << c.faces << " faces";
}
inline Counts count(const Mesh& mesh) {
  Counts c;
  for (Index v = 0; v < mesh.vertex_slots(); ++v) c.nodes += mesh.is_live_vertex(v);
  for (Index h = 0; h < mesh.half_edge_slots(); h += 2) c.edges += mesh.is_live_half_edge(h);
  for (Index f = 0; f < mesh.face_slots(); ++f) c.faces += mesh.is_live_face(f);
  return c;
}

/// The first defect, or "".
inline std::string defect(const Mesh& mesh, bool geometry = true) {
  const auto defects = find_defects(mesh, geometry);
  return defects.empty() ? "" : defects[0];
}

/// Interior nodes whose number of edges is not four.
inline int irregular_nodes(const Mesh& mesh) {
  int irregular = 0;
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    irregular += mesh.is_live_vertex(v) && !mesh.is_boundary(v) && mesh.valence(v) != 4;
  return irregular;
}

inline double area_of(const Mesh& mesh) {
  double twice = 0;
  for (const auto& [a, b] : boundary_of(mesh)) twice += cross(mesh.point(a), mesh.point(b));
  return twice / 2;
}

/// Every bit that the accessors show, dead slots included, as words of which any can be compared.
struct Snapshot {
  std::vector<Index> words;
  std::vector<double> coordinates;
  bool operator==(const Snapshot&) const = default;
};
inline Snapshot snapshot(const Mesh& mesh) {
  Snapshot s;
  s.words = {mesh.vertex_slots(), mesh.half_edge_slots(), mesh.face_slots()};
  for (Index v = 0; v < mesh.vertex_slots(); ++v) {
    s.words.insert(s.words.end(), {mesh.out(v), Index(mesh.is_fixed(v))});
    s.coordinates.insert(s.coordinates.end(), {mesh.point(v).x(), mesh.point(v).y()});
  }
  for (Index h = 0; h < mesh.half_edge_slots(); ++h)
    s.words.insert(s.words.end(), {mesh.origin(h), mesh.next(h), mesh.prev(h), mesh.face(h)});
  for (Index f = 0; f < mesh.face_slots(); ++f) s.words.insert(s.words.end(), {mesh.half_edge(f), mesh.degree(f)});
  return s;
}

/// Which diagonal cuts the cell in column x, row y of a grid.
enum class Diagonals { rising, falling, random };

/// Node y * (columns + 1) + x at (x, y). Cells that `is_hole(x, y)` names are left out.
template <class IsHole>
Mesh grid(Index columns, Index rows, Diagonals diagonals, Rng& rng, const IsHole& is_hole) {
  std::vector<Vec2> points;
  for (Index y = 0; y <= rows; ++y)
    for (Index x = 0; x <= columns; ++x) points.emplace_back(x, y);
  std::vector<std::array<Index, 3>> triangles;
  for (Index y = 0; y < rows; ++y)
    for (Index x = 0; x < columns; ++x) {
      if (is_hole(x, y)) continue;
      const Index a = y * (columns + 1) + x, b = a + 1, d = a + columns + 1, c = d + 1;
      const bool rising = diagonals == Diagonals::rising || (diagonals == Diagonals::random && rng.chance(0.5));
      if (rising)
        triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
      else
        triangles.insert(triangles.end(), {{a, b, d}, {b, c, d}});
    }
  return Mesh(points, triangles);
}
inline Mesh grid(Index columns, Index rows, Diagonals diagonals) {
  Rng rng(0);
  return grid(columns, rows, diagonals, rng, [](Index, Index) { return false; });
}

/// The same in quads.
inline Mesh quad_grid(Index columns, Index rows) {
  Mesh mesh = grid(columns, rows, Diagonals::rising);
  for (Index y = 0; y < rows; ++y)
    for (Index x = 0; x < columns; ++x)
      mesh.join_faces(edge(mesh, y * (columns + 1) + x, (y + 1) * (columns + 1) + x + 1));
  return mesh;
}

/// A grid of 2 to 6 cells each way with random diagonals, up to four square holes, and inner nodes that are moved or,
/// in one mesh of three, exactly in line. Every triangle is counter-clockwise.
inline Mesh random_mesh(Rng& rng) {
  const auto columns = Index(rng.range(2, 6)), rows = Index(rng.range(2, 6));
  std::vector<std::pair<Index, Index>> holes;
  for (Index y = 1; y + 1 < rows; y += 2)
    for (Index x = 1; x + 1 < columns; x += 2)
      if (rng.chance(0.3)) holes.emplace_back(x, y);
  Mesh mesh = grid(columns, rows, Diagonals::random, rng, [&](Index x, Index y) {
    return std::find(holes.begin(), holes.end(), std::pair(x, y)) != holes.end();
  });
  const double jitter = rng.chance(0.33) ? 0.0 : 0.24;
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    mesh.set_point(v, mesh.point(v) + Vec2(rng.between(-jitter, jitter), rng.between(-jitter, jitter)));
  return mesh;
}

}  // namespace qmorph::test
