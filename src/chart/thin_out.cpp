// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/thin_out.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "chart/rework.hpp"
#include "chart/windows.hpp"
#include "kernel/is_any.hpp"
#include "kernel/sort_unique.hpp"
#include "smoothing/node_energy.hpp"
#include "smoothing/smooth.hpp"
#include "stretch/window.hpp"

namespace qmorph::chart {
namespace {

constexpr WindowSize kWindow{6, 3, 400};
/// An edge that two become is at most so many times as long as others around.
constexpr double kLongest = 1.9;
/// What is merged may not leave triangles with a smaller sine.
constexpr double kLeastSine = 0.2;

/// A node that goes, and the one that stays.
struct Merge {
  Index from, into;
};

double length(const SurfaceMesh& mesh, const Ground& ground, Index a, Index b) {
  const Eigen::Vector3d edge = mesh.points[b] - mesh.points[a];
  if (!ground.field) return edge.norm();
  const auto at = [&](Index v) {
    return ground.field->length(ground.background.foot_on(mesh.on[v], mesh.points[v]), edge);
  };
  return 0.5 * (at(a) + at(b));
}

std::vector<char> outer_nodes(const SurfaceMesh& mesh, const std::vector<Edge>& creases) {
  std::vector<char> outer(mesh.points.size(), 0);
  for (const auto& [a, b] : creases) outer[a] = outer[b] = 1;
  for (Index side = 0; side < mesh.open.size(); ++side)
    if (mesh.open[side]) {
      const Face& face = mesh.faces[side / 4];
      outer[face[side % 4]] = outer[face[next_corner(face, side % 4)]] = 1;
    }
  return outer;
}

/// As many as edges are too many, the shortest first; no two are neighbours.
std::vector<Merge> choose(const SurfaceMesh& mesh, const std::vector<double>& size, const std::vector<Edge>& creases,
                          const std::vector<Edge>& interface, const Ground& ground) {
  std::vector<char> taken = outer_nodes(mesh, creases);
  std::vector<std::vector<Index>> ends(mesh.points.size());
  double wanted = 0;
  for (const auto& [a, b] : interface) {
    ends[a].push_back(b), ends[b].push_back(a);
    wanted += 2 * length(mesh, ground, a, b) / (size[a] + size[b]);
  }
  std::vector<std::pair<double, Merge>> merges;  // by the relative length of what two edges become
  for (Index v = 0; v < ends.size(); ++v) {
    if (ends[v].size() != 2 || taken[v] || mesh.fixed[v]) continue;
    const Index a = ends[v][0], b = ends[v][1];
    const double joined = (length(mesh, ground, v, a) + length(mesh, ground, v, b)) / size[v];
    if (joined <= kLongest)
      merges.push_back({joined, {v, length(mesh, ground, v, a) < length(mesh, ground, v, b) ? a : b}});
  }
  std::sort(merges.begin(), merges.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first, a.second.from) < std::pair(b.first, b.second.from);
  });
  std::vector<Merge> chosen;
  const double most = std::floor(double(interface.size()) - wanted);
  std::vector<char> near(mesh.points.size(), 0);
  for (const auto& [joined, merge] : merges) {
    if (double(chosen.size()) >= most) break;
    if (near[merge.from]) continue;
    chosen.push_back(merge);
    for (Index v : ends[merge.from]) near[v] = 1;
  }
  return chosen;
}

bool merge_in(kernel::Mesh& mesh, Index from, Index into) {
  const Index h = mesh.find(from, into);
  if (h == kNone || !mesh.is_free(from) || !mesh.can_collapse(h)) return false;
  mesh.begin();
  mesh.collapse(h);
  std::vector<Index> around;
  for (Index e : mesh.around(into)) around.push_back(mesh.target(e));
  constexpr int kPasses = 3;
  smoothing::Star star;
  for (int pass = 0; pass < kPasses; ++pass)
    for (Index v : around) smoothing::relax_node(mesh, v, star);
  const bool good = mesh.is_star_above(into, kLeastSine) &&
                    std::all_of(around.begin(), around.end(), [&](Index v) { return mesh.is_valid_star(v); });
  good ? mesh.commit() : mesh.rollback();
  return good;
}

}  // namespace

std::vector<double> mean_edges(const SurfaceMesh& mesh, const Ground& ground) {
  std::vector<double> sum(mesh.points.size(), 0), count(mesh.points.size(), 0);
  for (const Face& face : mesh.faces)
    for (Index i = 0; i < degree(face); ++i) {
      const Index a = face[i], b = face[next_corner(face, i)];
      const double l = length(mesh, ground, a, b);
      sum[a] += l, sum[b] += l, ++count[a], ++count[b];
    }
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] = count[v] > 0 ? sum[v] / count[v] : 0;
  return sum;
}

std::vector<Index> thin_out(SurfaceMesh& mesh, const std::vector<double>& size, const std::vector<Edge>& creases,
                            std::vector<Edge>& interface, const Ground& ground, Budget& budget) {
  if (std::any_of(mesh.faces.begin(), mesh.faces.end(), [](const Face& face) { return degree(face) != 3; })) return {};
  const std::vector<Merge> merges = choose(mesh, size, creases, interface, ground);
  if (merges.empty()) return {};
  std::vector<Index> goes_into(mesh.points.size(), kNone);
  std::vector<char> waiting(mesh.points.size(), 0);
  for (const Merge& merge : merges) goes_into[merge.from] = merge.into, waiting[merge.from] = 1;
  std::vector<Index> stays(mesh.points.size());  // where interfaces run now
  std::iota(stays.begin(), stays.end(), 0);
  std::vector<Index> changed;
  while (is_any(waiting)) {
    const std::vector<Index> opposite = opposite_sides(mesh);
    const std::vector<Window> windows = take_windows(mesh, opposite, sides_on(mesh, creases), kWindow, waiting, budget);
    if (windows.empty()) break;
    std::vector<Reworked> results;
    for (const Window& window : windows) {
      const auto& [piece, chart] = *window.laid_out;
      const auto stretched = stretch::StretchedWindow::of(*window.laid_out, ground);
      Reworked work{&piece, stretched ? stretched->mesh() : piece.mesh(chart.flat()), {}};
      bool merged = false;
      for (Index v = 0; v < piece.points.size(); ++v) {
        const Index from = piece.vertex[v], into = goes_into[from];
        if (into == kNone || waiting[from]) continue;
        goes_into[from] = kNone;
        const auto at = std::find(piece.vertex.begin(), piece.vertex.end(), into);
        if (at == piece.vertex.end() || !merge_in(work.mesh, v, Index(at - piece.vertex.begin()))) continue;
        stays[from] = into;
        merged = true;
        changed.push_back(into);
      }
      if (!merged) continue;
      if (stretched) stretched->bring_back(work.mesh);
      work.lifted = lift(work.mesh, piece, chart, ground.background);
      results.push_back(std::move(work));
    }
    mesh = replace(mesh, results);
  }
  const auto stays_at = [&](Index v) {
    while (stays[v] != v) v = stays[v];
    return v;
  };
  for (Edge& edge : interface) edge = std::minmax(stays_at(edge.first), stays_at(edge.second));
  std::erase_if(interface, [](const Edge& edge) { return edge.first == edge.second; });
  sort_unique(interface);
  for (Index& v : changed) v = stays_at(v);
  sort_unique(changed);
  return changed;
}

}  // namespace qmorph::chart
