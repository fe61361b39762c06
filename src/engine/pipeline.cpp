// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/pipeline.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "cleanup/clean_up.hpp"
#include "cleanup/open_tip.hpp"
#include "cleanup/patterns/pattern_cleanup.hpp"
#include "cleanup/repair.hpp"
#include "cleanup/replace_cavities.hpp"
#include "elimination/eliminate.hpp"
#include "front/morph.hpp"
#include "smoothing/corner_energy.hpp"
#include "smoothing/grid.hpp"
#include "smoothing/smooth.hpp"
#include "topology/edits.hpp"

namespace qmorph {

#ifdef QMORPH_CHECKS
constexpr bool kChecksAlways = true;
#else
constexpr bool kChecksAlways = false;
#endif

using Clock = std::chrono::steady_clock;

/// The share of its allowed work that a region may have spent when each of these is done; what one stage leaves is
/// there for the next.
constexpr double kElimination = 0.2, kRoughSmoothing = 0.3, kBoundary = 0.35, kCleanup = 0.7, kFinalSmoothing = 0.78,
                 kRepair = 0.87, kShape = 0.9, kPoorCavities = 0.97;
/// The share that repairs in twos may cost, which are many tries for few elements; more where not much is allowed, as
/// long as it is little for a face.
constexpr double kRepairInTwos = 0.01, kMostRepairInTwos = 0.018, kRepairInTwosOfFace = 54;

Pipeline::Pipeline(const Options& options, ConversionReport& report, Record& record, const kernel::Mesh& start,
                   double allowed)
    : options_(options),
      report_(report),
      record_(record),
      keeps_stages_(wants_stages(options)),
      start_(Clock::now()),
      allowed_(std::max(0.0, allowed)) {
  double nothing = 0;
  end_stage(Stage::input, start, nothing);
}

void Pipeline::progress(std::string_view stage, double share) const {
  if (options_.progress && options_.progress(stage, share) == Progress::cancel) throw Cancelled();
}

void Pipeline::end_stage(Stage stage, const kernel::Mesh& mesh, double& seconds) {
  const double passed = std::chrono::duration<double>(Clock::now() - start_).count();
  seconds += passed;
  if (keeps_stages_) {
    record_.stages[std::size_t(stage)] = mesh;
    record_.seconds[std::size_t(stage)] += passed;
  }
  start_ = Clock::now();
}

bool Pipeline::advance_front(kernel::Mesh& mesh, const Plane& plane, front::Decisions* decisions) {
  mesh.check_commits(kChecksAlways || options_.check_each_step);
  front::MorphSettings settings;
  settings.check_each_step = options_.check_each_step;
  settings.progress = [&](double share) { progress("front", 0.5 * share); };
  settings.observer = options_.observer;
  settings.decisions = decisions;
  bool is_astray = false;
  settings.is_astray = &is_astray;
  settings.frame = {plane.origin, plane.axis_u, plane.axis_v};
  if (options_.observer) settings.lift = plane.curved;
  if (auto watcher = front::morph(mesh, options_.front, settings)) record_.fronts.push_back(std::move(watcher));
  report_.front_quads += count_faces(mesh, 4);
  report_.leftover_triangles += count_faces(mesh, 3);
  end_stage(Stage::front, mesh, report_.front_seconds);
  return !is_astray;
}

kernel::Budget Pipeline::until(const kernel::Mesh& mesh, double share) const {
  const auto most = std::size_t(share * allowed_);
  return {mesh, most - std::min(most, mesh.work())};
}

double Pipeline::spent(const kernel::Mesh& mesh) const { return allowed_ > 0 ? double(mesh.work()) / allowed_ : 1; }

void Pipeline::finish(kernel::Mesh& mesh) {
  clean(mesh);
  polish(mesh);
}

void Pipeline::clean_further(kernel::Mesh& mesh) {
  cleanup::clean_up(mesh, options_.smoothing, until(mesh, kCleanup));
  end_stage(Stage::cleanup, mesh, report_.cleanup_seconds);
}

void Pipeline::clean(kernel::Mesh& mesh, const cleanup::CavityLimits& limits) {
  mesh.check_commits(kChecksAlways || options_.check_each_step);
  const kernel::Budget elimination = until(mesh, kElimination);
  elimination::eliminate_triangles(mesh, options_.smoothing, elimination::Means::moving, elimination);
  note(elimination);
  end_stage(Stage::elimination, mesh, report_.elimination_seconds);
  progress("smoothing", 0.5);
  SmoothingOptions rough = options_.smoothing;  // good enough for cleanup to judge shapes
  rough.iterations = std::min(rough.iterations, 2);
  smoothing::smooth(mesh, rough, until(mesh, kRoughSmoothing));
  end_stage(Stage::smoothing, mesh, report_.smoothing_seconds);
  progress("cleanup", 0.55);
  const kernel::Budget boundary = until(mesh, kBoundary), cleanup = until(mesh, kCleanup);
  cleanup::eliminate_chevrons(mesh, options_.cleanup, options_.smoothing, boundary);
  cleanup::clean_up_boundary(mesh, options_.cleanup, options_.smoothing, boundary);
  note(boundary);
  cleanup::clean_up(mesh, options_.smoothing, cleanup, limits);
  cleanup::clean_up_connectivity(mesh, options_.cleanup, options_.smoothing, cleanup);
  note(cleanup);
  end_stage(Stage::cleanup, mesh, report_.cleanup_seconds);
  progress("cleanup", 0.75);
}

void Pipeline::remove_doublet(kernel::Mesh& mesh, Index v) const {
  if (!mesh.is_live_vertex(v) || !mesh.is_free(v) || mesh.valence(v) != 2) return;
  constexpr int kRings = 2;
  std::vector<Index> nodes{v};
  mesh.begin();
  topology::remove_doublets(mesh, nodes);
  smoothing::smooth_near(mesh, options_.smoothing, nodes, kRings) ? mesh.commit() : mesh.rollback();
}

void Pipeline::clean_near(kernel::Mesh& mesh, const std::vector<Index>& interface) {
  constexpr int kRings = 2;  // with 4 nothing is better
  mesh.check_commits(kChecksAlways || options_.check_each_step);
  for (Index v : interface) remove_doublet(mesh, v);
  std::vector<Index> nodes = interface;
  for (Index f : topology::grow(mesh, topology::faces_around(mesh, nodes), kRings))
    for (Index v : topology::nodes_of(mesh, f)) nodes.push_back(v);
  topology::keep_live(mesh, nodes);
  smoothing::smooth_near(mesh, options_.smoothing, nodes, 0);
  cleanup::clean_up_near(mesh, options_.smoothing, nodes, until(mesh, kCleanup));
  end_stage(Stage::cleanup, mesh, report_.cleanup_seconds);
}

void Pipeline::polish(kernel::Mesh& mesh) {
  progress("smoothing", 0.8);
  smoothing::smooth(mesh, options_.smoothing, until(mesh, kFinalSmoothing));
  end_stage(Stage::final_smoothing, mesh, report_.smoothing_seconds);
  const kernel::Budget repair = until(mesh, kRepair), shape = until(mesh, kShape),
                       cavities = until(mesh, kPoorCavities);
  cleanup::repair(mesh, options_.smoothing, repair);
  note(repair);
  cleanup::clean_up_shape(mesh, options_.cleanup, options_.smoothing, shape);
  note(shape);
  cleanup::replace_poor_cavities(mesh, options_.smoothing, cavities);
  note(cavities);
  const double in_twos = std::clamp(kRepairInTwosOfFace * double(mesh.face_slots()), kRepairInTwos * allowed_,
                                    kMostRepairInTwos * allowed_);
  cleanup::repair_in_twos(mesh, options_.smoothing,
                          until(mesh, std::min(1.0, spent(mesh) + (allowed_ > 0 ? in_twos / allowed_ : 0))));
  // Better shapes may have opened a way for triangles that found none before.
  if (count_faces(mesh, 3) > 1) {
    const kernel::Budget last = until(mesh, 1);
    elimination::eliminate_triangles(mesh, options_.smoothing, elimination::Means::cutting, last);
    cleanup::clean_up(mesh, options_.smoothing, last);
    smoothing::smooth(mesh, options_.smoothing, last);
    cleanup::repair(mesh, options_.smoothing, last);
    note(last);
  }
  if (options_.smoothing.method == SmoothingMethod::shape_energy && !smoothing::snap_to_grid(mesh))
    smoothing::raise_worst_corners(mesh, options_.smoothing, until(mesh, 1));
  progress("smoothing", 1);
  end_stage(Stage::repair, mesh, report_.cleanup_seconds);
}

void Pipeline::open_tips(kernel::Mesh& mesh) {
  if (cleanup::open_tips(mesh, options_.smoothing) == 0) return;
  if (options_.smoothing.method == SmoothingMethod::shape_energy)
    smoothing::raise_worst_corners(mesh, options_.smoothing, until(mesh, 1));
  end_stage(Stage::repair, mesh, report_.cleanup_seconds);
}

std::size_t count_faces(const kernel::Mesh& mesh, Index degree) {
  std::size_t count = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f) count += mesh.is_live_face(f) && mesh.degree(f) == degree;
  return count;
}

std::optional<SurfaceError> find_fault(const kernel::Mesh& mesh, const Region& region, const Plane& plane) {
  std::size_t triangles = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    const auto error_at = [&](const char* what, const char* why) {
      const Eigen::Vector3d place = plane.to_space(mesh.point(mesh.origin(mesh.half_edge(f))));
      return SurfaceError(what + describe(place) + why + "; refine the triangles or the boundary there",
                          {.kind = ErrorKind::no_valid_mesh, .place = place});
    };
    if (!mesh.is_valid_face(f)) return error_at("no valid element was found at ", "");
    if (mesh.degree(f) == 3 && ++triangles > region.boundary_sides % 2)
      return error_at("the triangle at ", " could not be removed");
  }
  return {};
}

}  // namespace qmorph
