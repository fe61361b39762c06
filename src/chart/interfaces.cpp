// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/interfaces.hpp"

#include <algorithm>

#include "chart/local_numbers.hpp"
#include "chart/thin_out.hpp"
#include "chart/topology.hpp"
#include "chart/windows.hpp"
#include "engine/parts/interface.hpp"
#include "kernel/is_any.hpp"
#include "kernel/sort_unique.hpp"
#include "stretch/window.hpp"

namespace qmorph::chart {
namespace {

constexpr WindowSize kStraighteningWindow{9, 4, 1500};

/// Straightens the interfaces in one window. The parts that they part there are numbered for the window alone.
void straighten_window(SurfaceMesh& mesh, const std::vector<Index>& opposite, const std::vector<bool>& is_cut,
                       const std::vector<Edge>& interface, const Window& window, const Ground& ground) {
  const Piece& piece = window.laid_out->piece;
  const Chart& chart = window.laid_out->chart;
  const auto stretched = stretch::StretchedWindow::of(*window.laid_out, ground);
  kernel::Mesh flat = stretched ? stretched->mesh() : piece.mesh(chart.flat());
  qmorph::Division division;
  division.part.assign(flat.face_slots(), 0);
  const auto sides = components(window.faces, opposite, is_cut);
  division.parts = Index(sides.size());
  const LocalNumbers local(window.faces, mesh.faces.size());
  for (Index s = 0; s < sides.size(); ++s)
    for (Index f : sides[s]) division.part[local[f]] = s;
  std::vector<Index> nodes;
  for (Index h = 0; h < flat.half_edge_slots(); ++h)
    if (is_among(interface, piece.vertex[flat.origin(h)], piece.vertex[flat.target(h)]))
      nodes.push_back(flat.origin(h));
  sort_unique(nodes);
  straighten_interfaces(flat, division, nodes);
  if (stretched) stretched->bring_back(flat);
  const Lifted lifted = lift(flat, piece, chart, ground.background);
  for (Index v = 0; v < piece.points.size(); ++v) {
    mesh.points[piece.vertex[v]] = lifted.points[v];
    mesh.on[piece.vertex[v]] = lifted.on[v];
  }
}

/// `waiting`: nodes of interfaces that have to be looked at.
void straighten_around(SurfaceMesh& mesh, const std::vector<Edge>& creases, const std::vector<Edge>& interface,
                       std::vector<char> waiting, const Ground& ground, Budget& budget) {
  const std::vector<Index> opposite = opposite_sides(mesh);
  const std::vector<bool> is_crease = sides_on(mesh, creases);
  std::vector<bool> is_cut = sides_on(mesh, interface);
  for (std::size_t side = 0; side < is_cut.size(); ++side) is_cut[side] = is_cut[side] || is_crease[side];
  while (is_any(waiting)) {
    const std::vector<Window> windows = take_windows(mesh, opposite, is_crease, kStraighteningWindow, waiting, budget);
    if (windows.empty()) return;
    for (const Window& window : windows) straighten_window(mesh, opposite, is_cut, interface, window, ground);
  }
}

}  // namespace

bool is_among(const std::vector<Edge>& edges, Index a, Index b) {
  const Edge edge = std::minmax(a, b);
  return std::binary_search(edges.begin(), edges.end(), edge);
}

std::vector<Edge> edges_on(const SurfaceMesh& mesh, const std::vector<bool>& sides) {
  std::vector<Edge> edges;
  for (Index side = 0; side < sides.size(); ++side) {
    if (!sides[side]) continue;
    const Face& face = mesh.faces[side / 4];
    edges.emplace_back(std::minmax(face[side % 4], face[next_corner(face, side % 4)]));
  }
  sort_unique(edges);
  return edges;
}

std::vector<bool> sides_on(const SurfaceMesh& mesh, const std::vector<Edge>& edges) {
  std::vector<bool> result(4 * mesh.faces.size(), false);
  std::vector<char> touched(mesh.points.size(), 0);
  for (const auto& [a, b] : edges) touched[a] = touched[b] = 1;
  for (Index f = 0; f < mesh.faces.size(); ++f)
    for (Index i = 0; i < degree(mesh.faces[f]); ++i) {
      const Index a = mesh.faces[f][i], b = mesh.faces[f][next_corner(mesh.faces[f], i)];
      if (touched[a] && touched[b] && is_among(edges, a, b)) result[4 * f + i] = true;
    }
  return result;
}

void straighten(SurfaceMesh& mesh, const std::vector<Edge>& creases, std::vector<Edge>& interface, const Ground& ground,
                Budget& budget) {
  if (interface.empty()) return;
  constexpr int kSteps = 4;  // along the interface from a node that another has become
  const std::vector<double> size = mean_edges(mesh, ground);
  std::vector<char> waiting(mesh.points.size(), 0);
  for (const auto& [a, b] : interface) waiting[a] = waiting[b] = 1;
  straighten_around(mesh, creases, interface, waiting, ground, budget);
  const std::vector<Index> changed = thin_out(mesh, size, creases, interface, ground, budget);
  if (changed.empty()) return;
  waiting.assign(mesh.points.size(), 0);
  for (Index v : changed) waiting[v] = 1;
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<char> before = waiting;
    for (const auto& [a, b] : interface)
      if (before[a] || before[b]) waiting[a] = waiting[b] = 1;
  }
  straighten_around(mesh, creases, interface, std::move(waiting), ground, budget);
}

}  // namespace qmorph::chart
