// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/improve_region.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "cleanup/clean_up.hpp"
#include "cleanup/repair.hpp"
#include "elimination/eliminate.hpp"
#include "engine/mixed.hpp"
#include "engine/pipeline.hpp"
#include "engine/prepare.hpp"
#include "kernel/sort_unique.hpp"
#include "smoothing/corner_energy.hpp"
#include "topology/edits.hpp"

namespace qmorph {
namespace {

/// By what a mesh of quads is judged.
struct Figures {
  double least = -1, mean = -1;  ///< scaled Jacobian; without a quad, that of no quad that could be worse
  std::size_t poor = 0;          ///< quads with one that solvers do not like

  /// In none of the three.
  bool is_worse_than(const Figures& other) const {
    constexpr double kRounding = 1e-9;
    return least < other.least - kRounding || mean < other.mean - kRounding || poor > other.poor;
  }
};

Figures figures_of(const kernel::Mesh& mesh) {
  constexpr double kPoor = 0.2;
  Figures figures;
  double least = 1, sum = 0;
  std::size_t quads = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f) || !mesh.is_quad(f)) continue;
    const double sine = mesh.smallest_sine(f);
    least = std::min(least, sine);
    figures.poor += sine < kPoor;
    sum += sine, ++quads;
  }
  if (quads == 0) return {.poor = mesh.face_slots()};
  figures.least = least;
  figures.mean = sum / double(quads);
  return figures;
}

/// The nodes of elements that are not as they were in `before`, of which `mesh` was made.
std::vector<Index> changed_nodes(const kernel::Mesh& before, const kernel::Mesh& mesh) {
  std::vector<Index> nodes;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    const std::vector<Index> now = topology::nodes_of(mesh, f);
    const auto stays = [&](Index v) {
      return v < before.vertex_slots() && before.is_live_vertex(v) && before.point(v) == mesh.point(v);
    };
    const bool was_there = f < before.face_slots() && before.is_live_face(f) && topology::nodes_of(before, f) == now;
    if (!was_there || !std::all_of(now.begin(), now.end(), stays)) nodes.insert(nodes.end(), now.begin(), now.end());
  }
  sort_unique(nodes);
  return nodes;
}

/// Changes the mesh only as far as it takes for the triangles to go, and where elements are poor.
kernel::Mesh pair_triangles_only(const kernel::Mesh& start, const SmoothingOptions& smoothing, bool mends_all) {
  kernel::Mesh mesh = start;
  elimination::eliminate_triangles(mesh, smoothing);
  cleanup::clean_up_near(mesh, smoothing, changed_nodes(start, mesh));
  if (mends_all) {
    cleanup::repair(mesh, smoothing);
    smoothing::raise_worst_corners(mesh, smoothing);
  }
  return mesh;
}

/// All stages, with every quad cut into triangles first: that may allow what the quads leave no room for.
kernel::Mesh forget_quads(const ImproveStart& start, const Plane& plane, Pipeline& pipeline) {
  kernel::Mesh triangles(start.region.points, start.region.triangles, start.region.open);
  for (Index v : start.region.fixed) triangles.set_fixed(v);
  pipeline.advance_front(triangles, plane);
  pipeline.finish(triangles);
  return triangles;
}

/// The stages after the front, and the front where they find no valid elements.
kernel::Mesh make_anew(const ImproveStart& start, const Plane& plane, Pipeline& pipeline) {
  kernel::Mesh mesh = start.mesh;
  pipeline.finish(mesh);
  const std::optional<SurfaceError> fault = find_fault(mesh, start.region, plane);
  if (!fault) return mesh;

  kernel::Mesh triangles = forget_quads(start, plane, pipeline);
  if (find_fault(triangles, start.region, plane)) throw *fault;
  return triangles;
}

}  // namespace

ImproveStart start_improving(const Region& region, kernel::Mesh mesh, const Plane& plane, const Options& options) {
  ImproveStart start{region, std::move(mesh)};
  mend_quads(start.mesh, options.smoothing, plane);
  repair_input(start.mesh, region.node, plane);
  take_triangles(start.mesh, start.region);
  return start;
}

kernel::Mesh improve_region(const ImproveStart& start, const kernel::Mesh& input, const Plane& plane,
                            const Options& options, Budget& budget, ConversionReport& report, Record& record) {
  const Figures before = figures_of(input);
  Pipeline pipeline(options, report, record, input, budget.left());
  kernel::Mesh best = make_anew(start, plane, pipeline);
  Figures reached = figures_of(best);
  const auto consider = [&](kernel::Mesh mesh) {
    if (find_fault(mesh, start.region, plane)) return;
    const Figures figures = figures_of(mesh);
    const bool fewer_poor = std::pair(figures.poor, -figures.mean) < std::pair(reached.poor, -reached.mean);
    if (figures.is_worse_than(before) && !fewer_poor) return;
    best = std::move(mesh);
    reached = figures;
  };
  for (const bool mends_all : {true, false})
    if (reached.is_worse_than(before)) consider(pair_triangles_only(start.mesh, options.smoothing, mends_all));
  if (reached.is_worse_than(before)) consider(input);
  if (reached.is_worse_than(before)) consider(forget_quads(start, plane, pipeline));
  if (reached.is_worse_than(before)) ++report.worse_regions;
  if (wants_stages(options)) record.stages.back() = best;
  return best;
}

}  // namespace qmorph
