// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/rework.hpp"

#include <algorithm>
#include <tuple>

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

void drop_flat_pairs(SurfaceMesh& mesh, const std::vector<std::pair<Index, Index>>& creases) {
  std::vector<Index> faces_at(mesh.points.size(), 0);
  for (const Face& face : mesh.faces)
    for (Index i = 0; i < degree(face); ++i) ++faces_at[face[i]];
  const auto is_enclosed = [&](Index v) { return faces_at[v] == 2 && !mesh.fixed[v]; };
  std::vector<std::pair<Face, Index>> candidates;  // nodes in the order of their numbers, and the face
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    Face face = mesh.faces[f];
    if (degree(face) != 4) continue;
    for (Index i = 0; i < 4; ++i) {
      if (!is_enclosed(face[i]) || !is_enclosed(face[(i + 1) % 4])) continue;
      const auto must_stay = [&](Index k) {
        const std::pair<Index, Index> edge = std::minmax(face[k % 4], face[(k + 1) % 4]);
        return mesh.open[4 * f + k % 4] || std::binary_search(creases.begin(), creases.end(), edge);
      };
      if (must_stay(i + 3) || must_stay(i) || must_stay(i + 1)) continue;
      std::sort(face.begin(), face.end());
      candidates.emplace_back(face, f);
      break;
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<char> gone(mesh.faces.size(), 0);
  bool is_any_gone = false;
  for (std::size_t k = 1; k < candidates.size(); ++k)
    if (candidates[k - 1].first == candidates[k].first)
      gone[candidates[k - 1].second] = gone[candidates[k].second] = is_any_gone = true;
  if (!is_any_gone) return;
  Index kept = 0;
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    if (gone[f]) continue;
    mesh.faces[kept] = mesh.faces[f];
    mesh.near[kept] = mesh.near[f];
    for (Index i = 0; i < 4; ++i) mesh.open[4 * kept + i] = mesh.open[4 * f + i];
    ++kept;
  }
  mesh.faces.resize(kept);
  mesh.near.resize(kept);
  mesh.open.resize(4 * kept);
}

bool has_double_edge(const Piece& piece) {
  std::vector<std::pair<Index, Index>> edges;  // from, to
  for (const Face& face : piece.faces)
    for (Index i = 0; i < degree(face); ++i) edges.emplace_back(face[i], face[next_corner(face, i)]);
  std::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) != edges.end();
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
