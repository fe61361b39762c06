// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/rework.hpp"

#include <algorithm>
#include <tuple>

#include "kernel/sort_unique.hpp"

namespace qmorph::chart {
namespace {

void put(const Reworked& work, SurfaceMesh& result) {
  const Piece& piece = *work.piece;
  const kernel::Mesh& mesh = work.mesh;
  std::vector<Index> vertex(mesh.vertex_slots(), kNone);
  for (Index v = 0; v < mesh.vertex_slots(); ++v) {
    if (!mesh.is_live_vertex(v)) continue;
    if (v >= piece.points.size()) {
      vertex[v] = result.add_point(work.lifted.points[v], work.lifted.on[v]);
      continue;
    }
    vertex[v] = piece.vertex[v];
    result.points[vertex[v]] = work.lifted.points[v];
    result.on[vertex[v]] = work.lifted.on[v];
  }
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    Face face{kNone, kNone, kNone, kNone};
    Index h = mesh.half_edge(f);
    result.near.push_back(work.lifted.on[mesh.origin(h)]);
    for (Index i = 0; i < mesh.degree(f); ++i, h = mesh.next(h)) face[i] = vertex[mesh.origin(h)];
    for (Index i = 0; i < 4; ++i, h = mesh.next(h)) {
      const bool is_side = i < mesh.degree(f) && mesh.is_boundary_edge(h);
      const std::pair<Index, Index> edge = std::minmax(face[i], is_side ? face[next_corner(face, i)] : face[i]);
      result.open.push_back(is_side && !std::binary_search(piece.seams.begin(), piece.seams.end(), edge));
    }
    result.faces.push_back(face);
  }
}

/// Edges inside a piece from one node of its rim to another, which may be joined outside of it, too.
std::vector<std::pair<Index, Index>> chords(const Reworked& work) {
  const kernel::Mesh& mesh = work.mesh;
  std::vector<std::pair<Index, Index>> edges;
  for (Index h = 0; h < mesh.half_edge_slots(); h += 2) {
    if (!mesh.is_live_half_edge(h) || mesh.is_boundary_edge(h)) continue;
    const Index a = mesh.origin(h), b = mesh.target(h);
    if (mesh.is_boundary(a) && mesh.is_boundary(b))
      edges.emplace_back(std::minmax(work.piece->node[a], work.piece->node[b]));
  }
  return edges;
}

}  // namespace

SurfaceMesh replace(const SurfaceMesh& mesh, const std::vector<Reworked>& pieces) {
  std::vector<bool> gone(mesh.faces.size(), false);
  for (const Reworked& work : pieces)
    for (Index f : work.piece->row) gone[f] = true;
  SurfaceMesh result;
  result.points = mesh.points;
  result.on = mesh.on;
  result.fixed = mesh.fixed;
  result.node = mesh.node;
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    if (gone[f]) continue;
    result.faces.push_back(mesh.faces[f]);
    result.near.push_back(mesh.near[f]);
    for (Index i = 0; i < 4; ++i) result.open.push_back(mesh.open[4 * f + i]);
  }
  for (const Reworked& work : pieces) put(work, result);
  return result;
}

SurfaceMesh replace_where_simple(const SurfaceMesh& mesh, std::vector<Reworked> pieces) {
  SurfaceMesh result = replace(mesh, pieces);
  std::vector<std::pair<Index, Index>> edges;
  for (const Reworked& work : pieces)
    for (const auto& edge : chords(work)) edges.push_back(edge);
  if (edges.empty()) return result;
  sort_unique(edges);
  std::vector<int> sides(edges.size(), 0);
  const auto place = [&](const std::pair<Index, Index>& edge) {
    return std::size_t(std::lower_bound(edges.begin(), edges.end(), edge) - edges.begin());
  };
  for (const Face& face : result.faces)
    for (Index i = 0; i < degree(face); ++i) {
      const std::pair<Index, Index> edge = std::minmax(result.node[face[i]], result.node[face[next_corner(face, i)]]);
      if (const std::size_t k = place(edge); k < edges.size() && edges[k] == edge) ++sides[k];
    }
  const auto is_double = [&](const auto& edge) { return sides[place(edge)] > 2; };
  const auto has_double = [&](const Reworked& work) {
    const auto its = chords(work);
    return std::any_of(its.begin(), its.end(), is_double);
  };
  return std::erase_if(pieces, has_double) > 0 ? replace_where_simple(mesh, std::move(pieces)) : result;
}

bool folds_onto_itself(const kernel::Mesh& mesh, const Piece& piece) {
  const auto node = [&](Index v) { return v < piece.points.size() ? piece.node[v] : kNone - 1 - v; };
  std::vector<std::tuple<Index, Index, bool>> edges;  // nodes, whether it is boundary
  for (Index h = 0; h < mesh.half_edge_slots(); h += 2) {
    if (!mesh.is_live_half_edge(h)) continue;
    const Index a = node(mesh.origin(h)), b = node(mesh.target(h)), low = std::min(a, b), high = std::max(a, b);
    if (low == high) return true;
    edges.emplace_back(low, high, mesh.is_boundary_edge(h));
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t k = 1; k < edges.size(); ++k) {
    const auto& [a, b, outer] = edges[k - 1];
    const auto& [c, d, other_outer] = edges[k];
    if (a == c && b == d && !(outer && other_outer)) return true;
  }
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_quad(f) || !mesh.is_live_face(f)) continue;
    const Index h = mesh.half_edge(f);
    const Index a = node(mesh.origin(h)), b = node(mesh.target(h)), c = node(mesh.target(mesh.next(h)));
    if (a == c || b == node(mesh.origin(mesh.prev(h)))) return true;
  }
  return false;
}

}  // namespace qmorph::chart
