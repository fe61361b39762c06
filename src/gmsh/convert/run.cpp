// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/convert/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "gmsh/convert/complaints.hpp"
#include "gmsh/convert/curve_sides.hpp"
#include "gmsh/convert/onto_geometry.hpp"
#include "gmsh/convert/pillow_bent.hpp"
#include "gmsh/convert/stop_watch.hpp"
#include "gmsh/geometry/facets.hpp"
#include "gmsh/model/extrusions.hpp"
#include "gmsh/model/high_order.hpp"
#include "gmsh/model/overlap.hpp"
#include "qmorph/check.hpp"
#include "qmorph/convert.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

/// In sides of an element: how far nodes may be from the triangles, by rounding and where a geometry arches over them.
constexpr double kOnTriangles = 1e-6, kOnGeometry = 1;

/// Where not even the quads that are there already may pass for good ones.
bool is_broken(ErrorKind kind) { return kind == ErrorKind::not_finite || kind == ErrorKind::bad_element; }

/// Anew, since nodes have moved.
void judge(ConvertedSurface& converted) {
  converted.judged.clear();
  for (std::size_t p = 0; p < converted.results.size(); ++p)
    converted.judged.emplace_back(converted.surface.parts[p].patch, converted.results[p]);
}

/// The quads of a surface may change.
void free_quads(SurfaceMesh& surface) {
  surface.quads_may_go = true;
  for (SurfacePart& part : surface.parts) part.quad_tags.clear();
}

}  // namespace

Run::Run(Task task, const Options& options, ModelReport& report, const std::map<int, Patch>& before)
    : task_(task),
      options_(options),
      report_(report),
      before_(before),
      model_(read_classified_mesh(report.warnings)),
      fixed_edges_(model_.mesh, model_.use) {
  if (task != Task::measure) warn_of_loose_parts(model_, report.warnings);
  links_ = read_periodic_links(model_.mesh);
  common_ = find_common_elements(model_.mesh, model_.use);
  local_.assign(model_.mesh.tags.size(), kNone);
}

void Run::visit(const std::vector<std::uint32_t>& entities) {
  if (task_ != Task::measure) {
    std::vector<PeriodicLink> extrusions = find_extrusions(model_.mesh, entities, links_);
    walls_ = find_extruded_walls(model_.mesh, extrusions);
    std::move(extrusions.begin(), extrusions.end(), std::back_inserter(links_));
  }
  families_ = find_families(links_);
  std::vector<Job> jobs;
  std::set<int> done;
  for (std::uint32_t entity : entities) {
    const int tag = model_.mesh.entities[entity].tag;
    if (!done.insert(tag).second) continue;
    const auto family = std::find_if(families_.begin(), families_.end(), [&](const PeriodicFamily& candidate) {
      return std::count(candidate.members.begin(), candidate.members.end(), tag);
    });
    if (family == families_.end() || task_ == Task::measure) {
      jobs.push_back(begin_alone(entity));
    } else {
      jobs.push_back(begin_family(*family, entities));
      done.insert(family->members.begin(), family->members.end());
    }
  }
  StopWatch watch;
  run_engine(jobs, task_ == Task::improve ? improve_all : convert_all, options_, model_.mesh);
  report_.convert_seconds += watch.lap();
  for (Job& job : jobs) {
    if (!job.is_left_alone) job.family ? finish_family(job) : finish_alone(job);
    report_.surfaces.insert(report_.surfaces.end(), job.reports.begin(), job.reports.end());
  }
  std::sort(report_.surfaces.begin(), report_.surfaces.end(),
            [](const SurfaceReport& a, const SurfaceReport& b) { return a.tag < b.tag; });
}

Job Run::begin_alone(std::uint32_t entity) {
  StopWatch watch;
  Job job{.entities = {entity}, .reports = {begin_report(model_.mesh, entity)}};
  SurfaceReport& report = job.reports[0];
  if (task_ == Task::measure || (report.triangles_in == 0 && (task_ == Task::convert || walls_.count(report.tag)))) {
    look_at(entity, report);
    job.is_left_alone = true;
  } else {
    try {
      job.converted.push_back(read(entity));
    } catch (const SurfaceError& error) {
      leave(report, error);
      job.is_left_alone = true;
    }
  }
  report.seconds = watch.lap();
  return job;
}

/// Either all surfaces of a family are converted or none.
Job Run::begin_family(const PeriodicFamily& family, const std::vector<std::uint32_t>& entities) {
  StopWatch watch;
  Job job{.family = &family};
  for (int member : family.members)
    for (std::uint32_t entity : entities)
      if (model_.mesh.entities[entity].tag == member) {
        job.entities.push_back(entity);
        job.reports.push_back(begin_report(model_.mesh, entity));
      }
  const std::size_t size = family.members.size();
  std::size_t at = 0;  // whose fault it is
  try {
    for (; at < size; ++at) {
      if (at >= job.entities.size() || job.reports[at].tag != family.members[at])
        throw SurfaceError("it is not to be converted, or has no elements", {.kind = ErrorKind::periodic});
      job.converted.push_back(read(job.entities[at]));
    }
    for (at = size; --at > 0;)
      match_parts(*family.link[at], model_.mesh, job.converted[family.master_of(at)].surface,
                  job.converted[at].surface);
  } catch (const SurfaceError& error) {
    leave_family(job, at, error, model_.mesh);
  }
  if (!job.reports.empty()) job.reports[0].seconds = watch.lap();
  return job;
}

void Run::finish_alone(Job& job) {
  StopWatch watch;
  try {
    settle(job.converted[0]);
    accept(std::move(job.converted[0]), job.reports[0]);
  } catch (const SurfaceError& error) {
    leave(job.reports[0], error);
  }
  job.reports[0].seconds += watch.lap();
}

void Run::finish_family(Job& job) {
  StopWatch watch;
  const PeriodicFamily& family = *job.family;
  std::size_t at = 0;
  try {
    for (; at < job.converted.size(); ++at) {
      if (at > 0) {
        const ConvertedSurface& master = job.converted[family.master_of(at)];
        job.converted[at].results = copy_results(*family.link[at], master, job.converted[at].surface, model_.mesh);
        job.converted[at].report = master.report;
        job.reports[at].image_of = family.members[0];
      }
      at == 0 ? settle(job.converted[at]) : settle_image(job.converted[at]);
    }
    for (at = 0; at < job.converted.size(); ++at) accept(std::move(job.converted[at]), job.reports[at]);
    job.reports[0].seconds += watch.lap();
  } catch (const SurfaceError& error) {
    leave_family(job, at, error, model_.mesh);
  }
}

ConvertedSurface Run::read(std::uint32_t entity) {
  if (const auto common = common_.find(entity); common != common_.end())
    throw SurfaceError(
        fmt::format("surface {} has the same element at {}; leave one of the two out",
                    model_.mesh.entities[common->second.other].tag, describe_node(model_.mesh, common->second.row)),
        {.kind = ErrorKind::overlap,
         .place = model_.mesh.points[common->second.row],
         .subject = surface_tag(model_.mesh.entities[common->second.other].tag)});
  StopWatch watch;
  ConvertedSurface converted;
  converted.surface = read_surface(model_.mesh, model_.use, fixed_edges_, entity, local_);
  if (task_ == Task::convert) {
    refuse_bad_quads(converted.surface);
    if (has_only_facets(model_.mesh, converted.surface, options_.crease_angle))
      for (SurfacePart& part : converted.surface.parts) part.patch.is_smooth = true;
  } else {
    refuse_crossed_quads(converted.surface);
    free_quads(converted.surface);
  }
  report_.read_seconds += watch.lap();
  return converted;
}

/// \throws SurfaceError
void Run::check(ConvertedSurface& converted, double beside) const {
  const InputQuads quads_are = task_ == Task::convert ? InputQuads::kept : InputQuads::free;
  judge(converted);
  for (Judged& judged : converted.judged)
    if (const std::optional<Defect> defect = find_defect(judged, quads_are, beside))
      throw SurfaceError("the result is not valid: " + defect->what + "; this is a mistake of qmorph",
                         {.kind = ErrorKind::no_valid_mesh, .place = defect->place});
}

/// The last word on where nodes are.
/// \throws SurfaceError
void Run::settle(ConvertedSurface& converted) {
  StopWatch watch;
  pillow_bent_quads(model_.mesh, converted);
  check(converted, kOnTriangles);
  const Lander lander = find_lander(model_.mesh, converted.surface.entity);
  if (lander) {
    const std::vector<QuadMesh> on_triangles = converted.results;
    put_onto(lander, converted);
    try {
      check(converted, kOnGeometry);
    } catch (const SurfaceError&) {
      converted.results = on_triangles;
      judge(converted);
      converted.on_geometry = {0, converted.on_geometry.all()};
    }
  }
  curve_sides(model_.mesh, lander, converted);
  report_.check_seconds += watch.lap();
}

/// An image has the places of its master's nodes, but parameters of its own.
/// \throws SurfaceError
void Run::settle_image(ConvertedSurface& converted) {
  StopWatch watch;
  const Lander lander = find_lander(model_.mesh, converted.surface.entity);
  check(converted, lander ? kOnGeometry : kOnTriangles);
  if (lander) find_parameters(lander, converted);
  curve_sides(model_.mesh, lander, converted);
  report_.check_seconds += watch.lap();
}

void Run::accept(ConvertedSurface converted, SurfaceReport& report) {
  StopWatch watch;
  report.outcome = SurfaceOutcome::converted;
  report.reason = converted.bent;
  figures_.add_result(converted, report);
  if (task_ == Task::improve) figures_.compare_with_input(converted, report);
  converted.judged.clear();
  converted_.push_back(std::move(converted));
  report_.check_seconds += watch.lap();
}

/// At a surface that stays as it is in any case.
void Run::look_at(std::uint32_t entity, SurfaceReport& report) {
  report.outcome = SurfaceOutcome::already_quads;
  SurfaceMesh surface;
  try {
    surface = read_surface(model_.mesh, model_.use, fixed_edges_, entity, local_);
  } catch (const SurfaceError& error) {
    if (task_ != Task::measure && is_broken(error.kind())) return leave(report, error);
    report.reason = error.what();
    report.error = error.details();
    return;  // there are no figures for it
  }
  if (task_ == Task::measure) find_faults(surface, report);
  try {
    if (task_ == Task::convert) refuse_bad_quads(surface);
  } catch (const SurfaceError& error) {
    return leave(report, error);
  }
  const auto before = before_.find(report.tag);
  figures_.add_as_it_is(surface, before == before_.end() ? nullptr : &before->second, report);
}

/// What no figure shows.
void Run::find_faults(const SurfaceMesh& surface, SurfaceReport& report) const {
  const EntityMesh& mesh = model_.mesh.entities[surface.entity];
  const std::string where = order_of(mesh) > 1 ? find_bent(read_curved_elements(model_.mesh, mesh)) : "";
  if (!where.empty()) report.reason = "a curved edge turns an element over " + where;
  if (!surface.edge_of_many.empty())
    report.reason = "it is not a manifold: more than two elements share an edge, " + surface.edge_of_many;
}

void Run::finish() {
  StopWatch watch;
  figures_.put_into(report_);
  report_.check_seconds += watch.lap();
  restore_periodicity(model_.mesh, converted_, replace_surfaces(model_.mesh, converted_), links_);
  report_.replace_seconds = watch.lap();
}

}  // namespace qmorph::adapter
