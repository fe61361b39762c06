// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/convert_region.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "chart/curved_region.hpp"
#include "chart/interfaces.hpp"
#include "chart/rework.hpp"
#include "chart/windows.hpp"
#include "engine/pipeline.hpp"
#include "kernel/sort_unique.hpp"
#include "parallel/for_each.hpp"
#include "parallel/shared_progress.hpp"
#include "qmorph/error.hpp"
#include "space/improve.hpp"

namespace qmorph::chart {
namespace {

/// Faces of a chart: larger ones cost more than they are worth.
constexpr std::size_t kMostOfChart = 60'000;
constexpr WindowSize kCleaningWindow{8, 5, 800};

/// The plane of a chart, in which messages say where a point is in space.
Plane plane_of(const Chart& chart) {
  Plane plane;
  plane.curved = [&chart](const Vec2& p) { return chart.to_space(chart.nearest_of_all(p)); };
  return plane;
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

std::size_t count_bad(const kernel::Mesh& mesh) {
  std::size_t bad = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f) bad += mesh.is_live_face(f) && !mesh.is_valid_face(f);
  return bad;
}

/// Where the piece ends on both sides of a line, one node has two points there. An element may have got both, or two edges have become one.
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

class CurvedConverter {
 public:
  CurvedConverter(const CurvedRegion& region, const Options& options, ConversionReport& report)
      : region_(region), options_(options), report_(report), mesh_(region.start()) {
    options_.observer = nullptr;
    options_.part_triangles = 0;
    creases_ = region.creases;
  }

  SurfaceMesh run() {
    divide_region();
    work_on_parts();
    clean_interfaces();
    return space::improve(std::move(mesh_), creases_, region_, options_.smoothing);
  }

 private:
  const space::Background& background() const { return *region_.background; }

  void divide_region() {
    opposite_ = opposite_sides(mesh_);
    const std::vector<bool> is_crease = sides_on(mesh_, creases_);
    division_ = divide(mesh_, opposite_, is_crease, kMostOfChart);
    std::vector<bool> is_interface = division_.is_cut;
    for (std::size_t side = 0; side < is_interface.size(); ++side)
      if (is_crease[side]) is_interface[side] = false;
    interface_ = edges_on(mesh_, is_interface);
    straighten(mesh_, opposite_, is_crease, interface_, background());
    const std::vector<char> changed = make_parts_even(mesh_, opposite_, division_, creases_, interface_, background());
    for (Index p = 0; p < division_.parts.size(); ++p)
      if (changed[p] || !interface_.empty())
        division_.laid_out[p] = std::make_unique<LaidOut>(mesh_, opposite_, division_.is_cut, division_.parts[p]);
  }

  void work_on_parts() {
    const std::size_t parts = division_.parts.size();
    std::vector<Reworked> results(parts);
    std::vector<ConversionReport> reports(parts);
    const parallel::SharedProgress shared(options_.progress, double(mesh_.faces.size()));
    std::vector<ProgressCallback> progress;
    for (const auto& part : division_.parts) progress.push_back(shared.part(double(part.size())));
    parallel::for_each_index(parts, [&](std::size_t p) {
      const auto& [piece, chart] = *division_.laid_out[p];
      Options own = options_;
      own.progress = progress[p];
      results[p].piece = &piece;
      Record nothing;
      results[p].mesh = qmorph::convert_region(piece.region(chart.flat()), plane_of(chart), own, reports[p], nothing);
      results[p].lifted = lift(results[p].mesh, piece, chart, background());
    });
    for (const ConversionReport& some : reports) report_.add(some);
    mesh_ = replace(mesh_, results);
  }

  /// Interfaces were boundaries: irregular nodes beside them cancel now, and rows run straight on.
  void clean_interfaces() {
    if (interface_.empty()) return;
    std::vector<char> waiting(mesh_.points.size(), 0);
    for (const auto& [a, b] : interface_) waiting[a] = waiting[b] = 1;
    while (true) {
      waiting.resize(mesh_.points.size(), 0);
      opposite_ = opposite_sides(mesh_);
      const std::vector<bool> is_crease = sides_on(mesh_, creases_);
      const std::vector<Window> windows = take_windows(mesh_, opposite_, is_crease, kCleaningWindow, waiting);
      if (windows.empty()) return;
      std::vector<Reworked> results(windows.size());
      parallel::for_each_index(windows.size(), [&](std::size_t w) { results[w] = clean(*windows[w].laid_out); });
      std::erase_if(results, [](const Reworked& work) { return work.piece == nullptr; });
      mesh_ = replace(mesh_, results);
    }
  }

  /// Without a piece if nothing good came of it.
  Reworked clean(const LaidOut& window) const {
    const auto& [piece, chart] = window;
    Reworked work{&piece, piece.mesh(chart.flat()), {}};
    const std::size_t bad = count_bad(work.mesh);
    std::vector<Index> nodes(piece.points.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    ConversionReport nothing;
    Record no_record;
    Pipeline pipeline(options_, nothing, no_record, work.mesh);
    pipeline.clean_near(work.mesh, nodes);
    pipeline.polish(work.mesh);
    if (count_bad(work.mesh) > bad || folds_onto_itself(work.mesh, piece)) return {};
    work.lifted = lift(work.mesh, piece, chart, background());
    return work;
  }

  const CurvedRegion& region_;
  Options options_;
  ConversionReport& report_;
  SurfaceMesh mesh_;
  std::vector<Index> opposite_;
  std::vector<Edge> creases_, interface_;
  Division division_;
};

}  // namespace

SurfaceMesh convert_region(const CurvedRegion& region, const Options& options, ConversionReport& report) {
  return CurvedConverter(region, options, report).run();
}

}  // namespace qmorph::chart
