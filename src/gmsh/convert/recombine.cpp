// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "geometry/describe.hpp"
#include "gmsh/convert/classified.hpp"
#include "gmsh/convert/jobs.hpp"
#include "gmsh/convert/periodic.hpp"
#include "gmsh/convert/replace.hpp"
#include "gmsh/convert/stop_watch.hpp"
#include "gmsh/convert/whole_surface.hpp"
#include "gmsh/model/coincident_nodes.hpp"
#include "gmsh/model/high_order.hpp"
#include "gmsh/model/model_mesh.hpp"
#include "gmsh/model/overlap.hpp"
#include "gmsh/model/patches.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/check.hpp"
#include "qmorph/convert.hpp"
#include "qmorph/gmsh.hpp"
#include "quality/directed_size.hpp"

namespace qmorph {
namespace {

using namespace adapter;

/// What is done to a surface: its triangles are converted, or its quads improved as well, or nothing.
enum class Task { convert, improve, measure };

/// Quads of the input stay as they are, and what comes out must not have an inverted element.
void refuse_bad_quads(const SurfaceMesh& surface) {
  for (const SurfacePart& part : surface.parts)
    if (const std::optional<BadQuad> bad = find_bad_quad(part.patch))
      throw SurfaceError(fmt::format("its quad {} is inverted or not convex at {}; --cleanup-only (improve_quads()) mends such quads",
                                     part.quad_tags[bad->quad], describe(bad->place)),
                         {.kind = ErrorKind::bad_element,
                          .place = bad->place,
                          .subject = ErrorSubject{ErrorSubject::Kind::element, part.quad_tags[bad->quad]}});
}

/// Such a mesh looks right and falls apart, or lies twice in one place.
void warn_of_loose_parts(const ClassifiedMesh& model, std::vector<std::string>& warnings) {
  const CoincidentNodes found = find_coincident_nodes(model.mesh, model.use);
  if (found.count)
    warnings.push_back(fmt::format(
        "{} node{} where another one is, as {}: the elements there are not joined. Unless that is meant, as in a crack, "
        "Coherence; in the script of a geometry joins them, or Coherence Mesh; in one that merges the mesh",
        found.count, found.count == 1 ? " lies" : "s lie", describe_node(model.mesh, found.first)));
  if (const auto overlap = find_overlap(model.mesh))
    warnings.push_back(fmt::format(
        "surface {} lies over another one, or over itself, at {}: take one of the two out, or fuse them with Coherence; "
        "in the script of the geometry",
        overlap->surface, describe(overlap->where)));
}

/// Means of scaled Jacobians that differ by no more are the same.
constexpr double kSameMean = 1e-9;

/// A complaint, if quads are much longer or shorter than the triangles were.
std::string find_lost_size(const std::vector<DirectedSize>& sizes) {
  const DirectedSize size = median(sizes);
  if (largest_ratio(size) <= kLargestSizeRatio) return {};
  return fmt::format(
      "its quads are {:.1f} times as long as its triangles in the direction in which these are longest, and {:.1f} times in "
      "the other (medians)",
      size.along, size.across);
}

/// The quads of a surface may change.
void free_quads(SurfaceMesh& surface) {
  surface.quads_may_go = true;
  for (SurfacePart& part : surface.parts) part.quad_tags.clear();
}

/// One run over the surfaces of a model.
class Run {
 public:
  Run(Task task, const Options& options, ModelReport& report, const std::map<int, Patch>& before)
      : task_(task),
        options_(options),
        report_(report),
        before_(before),
        model_(read_classified_mesh(report.warnings)),
        fixed_edges_(model_.mesh, model_.use) {
    if (task != Task::measure) warn_of_loose_parts(model_, report.warnings);
    links_ = read_periodic_links(model_.mesh);
    families_ = find_families(links_);
    common_ = find_common_elements(model_.mesh, model_.use);
    local_.assign(model_.mesh.tags.size(), kNone);
  }

  void visit(const std::vector<std::uint32_t>& entities);
  void finish();
  const ModelMesh& mesh() const { return model_.mesh; }

 private:
  Job begin_alone(std::uint32_t entity);
  Job begin_family(const PeriodicFamily& family, const std::vector<std::uint32_t>& entities);
  void finish_alone(Job& job);
  void finish_family(Job& job);
  ConvertedSurface read(std::uint32_t entity);
  void accept(ConvertedSurface converted, SurfaceReport& report);
  void check(const ConvertedSurface& converted) const;
  void measure_quads(std::uint32_t entity, SurfaceReport& report);
  void compare_with_input(const ConvertedSurface& converted, SurfaceReport& report);
  void restore_periodicity(const std::vector<PartTags>& part_tags);

  const Task task_;
  const Options& options_;
  ModelReport& report_;
  const std::map<int, Patch>& before_;  ///< what is measured against, by surface
  ClassifiedMesh model_;
  FixedEdges fixed_edges_;
  std::vector<PeriodicLink> links_;
  std::vector<PeriodicFamily> families_;
  std::map<std::uint32_t, CommonElement> common_;
  std::vector<Index> local_;
  std::vector<ConvertedSurface> converted_;
  QualityAccumulator total_, total_before_;
  FidelityAccumulator fidelity_;
};

void Run::visit(const std::vector<std::uint32_t>& entities) {
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
  if (task_ == Task::measure || (report.triangles_in == 0 && task_ == Task::convert)) {
    measure_quads(entity, report);
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

/// All of a family, or none.
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
      check(job.converted[at]);
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
  if (task_ == Task::convert)
    refuse_bad_quads(converted.surface);
  else
    free_quads(converted.surface);
  report_.read_seconds += watch.lap();
  return converted;
}

/// \throws SurfaceError
void Run::check(const ConvertedSurface& converted) const {
  const InputQuads quads_are = task_ == Task::convert ? InputQuads::kept : InputQuads::free;
  for (std::size_t p = 0; p < converted.results.size(); ++p) {
    const SurfacePart& part = converted.surface.parts[p];
    if (const std::optional<Defect> defect = find_defect(part.patch, converted.results[p], quads_are))
      throw SurfaceError("the result is not valid: " + defect->what + "; this is a mistake of qmorph",
                         {.kind = ErrorKind::no_valid_mesh, .place = defect->place});
    const std::string where =
        find_bent_corner(model_.mesh, model_.mesh.entities[converted.surface.entity], part, converted.results[p]);
    if (!where.empty())
      throw SurfaceError("its curved edges would turn an element over " + where + "; refine the mesh there",
                         {.kind = ErrorKind::no_valid_mesh});
  }
}

void Run::accept(ConvertedSurface converted, SurfaceReport& report) {
  StopWatch watch;
  check(converted);
  QualityAccumulator quality;
  FidelityAccumulator fidelity;
  report.triangles_out = report.quads_out = 0;
  for (std::size_t p = 0; p < converted.results.size(); ++p) {
    const QuadMesh& result = converted.results[p];
    const Patch& patch = converted.surface.parts[p].patch;
    quality.add(patch, result);
    fidelity.add(patch, result);
    for (PoorQuad poor : explain_poor_quads(patch, result, quality.scaled_jacobians().subspan(report.quads_out))) {
      poor.quad += Index(report.quads_out);
      report.poor.push_back(poor);
    }
    report.triangles_out += result.triangles.size();
    report.quads_out += result.quads.size();
  }
  total_.add(quality);
  fidelity_.add(fidelity);
  report.fidelity = fidelity.result();
  report.outcome = SurfaceOutcome::converted;
  report.conversion = converted.report;
  report.warnings = converted.surface.warnings;
  if (std::string lost = find_lost_size(report.conversion.sizes); !lost.empty()) report.warnings.push_back(lost);
  report.quality = quality.result();
  if (task_ == Task::improve) compare_with_input(converted, report);
  converted_.push_back(std::move(converted));
  report_.check_seconds += watch.lap();
}

/// Quads that are to be improved are not to get worse, and where they have to, that is said.
void Run::compare_with_input(const ConvertedSurface& converted, SurfaceReport& report) {
  QualityAccumulator before;
  for (const SurfacePart& part : converted.surface.parts)
    before.add(part.patch.points, part.patch.triangles, part.patch.quads, mean_normal(part.patch));
  total_before_.add(before);
  const Quality was = before.result();
  if (report.conversion.worse_regions > 0)
    report.warnings.push_back(
        fmt::format("{} triangles could not go without quads getting worse: scaled Jacobian min {:.3f} -> {:.3f}, mean "
                    "{:.3f} -> {:.3f}",
                    report.triangles_in, was.scaled_jacobian_min, report.quality.scaled_jacobian_min,
                    was.scaled_jacobian_mean, report.quality.scaled_jacobian_mean));
}

void Run::measure_quads(std::uint32_t entity, SurfaceReport& report) {
  report.outcome = SurfaceOutcome::already_quads;
  SurfaceMesh surface;
  try {
    surface = read_surface(model_.mesh, model_.use, fixed_edges_, entity, local_);
  } catch (const SurfaceError& error) {
    report.reason = error.what();
    report.error = error.details();
    return;  // it stays as it is in any case, and there are no figures for it
  }
  if (task_ == Task::measure) {
    const std::string where = find_bent_corner(model_.mesh, model_.mesh.entities[entity]);
    if (!where.empty()) report.reason = "a curved edge turns an element over " + where;
    if (!surface.edge_of_many.empty())
      report.reason = "it is not a manifold: more than two elements share an edge, " + surface.edge_of_many;
  }
  try {
    if (task_ == Task::convert) refuse_bad_quads(surface);
  } catch (const SurfaceError& error) {
    return leave(report, error);
  }
  QualityAccumulator quality;
  for (const SurfacePart& part : surface.parts) quality.add(part.patch.points, part.patch.triangles, part.patch.quads);
  total_.add(quality);
  report.quality = quality.result();
  if (const auto before = before_.find(report.tag); before != before_.end()) {
    FidelityAccumulator fidelity;
    const Patch now = whole_surface(surface);
    report.conversion.sizes = directed_sizes(before->second, now.points, now.quads);
    fidelity.add_any(before->second, as_result(now));
    fidelity_.add(fidelity);
    report.fidelity = fidelity.result();
  }
}

void Run::finish() {
  StopWatch watch;
  report_.total = total_.result();
  const Quality before = total_before_.result();
  const bool said = std::any_of(report_.surfaces.begin(), report_.surfaces.end(),
                                [](const SurfaceReport& surface) { return surface.conversion.worse_regions > 0; });
  if (task_ == Task::improve && before.quads > 0 && !said &&
      report_.total.scaled_jacobian_mean < before.scaled_jacobian_mean - kSameMean)
    report_.warnings.push_back(
        fmt::format("the mean scaled Jacobian of all quads fell from {:.4f} to {:.4f}, since triangles became quads",
                    before.scaled_jacobian_mean, report_.total.scaled_jacobian_mean));
  report_.fidelity = fidelity_.result();
  report_.check_seconds += watch.lap();
  restore_periodicity(replace_surfaces(model_.mesh, converted_));
  report_.replace_seconds = watch.lap();
}

/// Pairs of new nodes where both surfaces were converted; the old ones where a surface had to be put back as it was.
void Run::restore_periodicity(const std::vector<PartTags>& part_tags) {
  std::map<int, std::size_t> index;
  for (std::size_t i = 0; i < converted_.size(); ++i) index[model_.mesh.entities[converted_[i].surface.entity].tag] = i;
  if (index.empty()) return;
  std::optional<ModelMesh> now;
  for (PeriodicLink& link : links_) {
    const auto slave = index.find(link.slave), master = index.find(link.master);
    if (slave == index.end() || master == index.end()) continue;
    link.nodes.clear();
    for (std::size_t p = 0; p < part_tags[slave->second].size(); ++p)
      for (std::size_t i = 0; i < part_tags[slave->second][p].size(); ++i)
        link.nodes.emplace_back(part_tags[slave->second][p][i], part_tags[master->second][p][i]);
    if (order_of(model_.mesh.entities[converted_[slave->second].surface.entity]) == 1) continue;
    if (!now) now = read_model_mesh();
    add_high_order_pairs(*now, link);
  }
  restore_links(links_);
}

/// Indices of the surfaces to look at, by tag.
std::vector<std::uint32_t> select_surfaces(const ModelMesh& mesh, const std::vector<int>& wanted) {
  std::vector<int> missing = wanted;
  std::vector<std::uint32_t> selected;
  for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
    if (mesh.entities[e].dim != 2) continue;
    std::erase(missing, mesh.entities[e].tag);
    const bool asked = wanted.empty() || std::count(wanted.begin(), wanted.end(), mesh.entities[e].tag);
    if (asked && mesh.entities[e].element_count()) selected.push_back(e);
  }
  if (!missing.empty())
    throw UsageError(fmt::format("the model has no surface {}", missing.front()),
                     {.kind = ErrorKind::no_such_entity, .subject = surface_tag(missing.front())});
  return selected;
}

ModelReport run(Task task, const std::vector<int>& surfaces, const Options& options,
                const std::map<int, Patch>& before = {}) {
  ModelReport report;
  const QuietErrors quiet;
  StopWatch watch;
  Run run(task, options, report, before);
  report.read_seconds += watch.lap();
  run.visit(select_surfaces(run.mesh(), surfaces));
  run.finish();
  return report;
}

}  // namespace

std::array<std::size_t, kPoorReasons> ModelReport::count_poor() const {
  std::array<std::size_t, kPoorReasons> counts{};
  for (const SurfaceReport& surface : surfaces)
    for (const PoorQuad& poor : surface.poor) ++counts[std::size_t(poor.reason)];
  return counts;
}

std::size_t ModelReport::count(SurfaceOutcome outcome) const {
  return static_cast<std::size_t>(std::count_if(surfaces.begin(), surfaces.end(),
                                                [outcome](const SurfaceReport& s) { return s.outcome == outcome; }));
}

ModelReport session::recombine(const Options& options, const std::vector<int>& surfaces) {
  return run(Task::convert, surfaces, options);
}

ModelReport session::improve_quads(const Options& options, const std::vector<int>& surfaces) {
  return run(Task::improve, surfaces, options);
}

ModelReport session::measure_surfaces(const std::vector<int>& surfaces, const std::map<int, Patch>& before) {
  return run(Task::measure, surfaces, {}, before);
}

std::map<int, Patch> session::read_surfaces(const std::vector<int>& surfaces) {
  std::vector<std::string> warnings;
  const QuietErrors quiet;
  const ClassifiedMesh model = read_classified_mesh(warnings);
  const FixedEdges fixed_edges(model.mesh, model.use);
  std::vector<Index> local(model.mesh.tags.size(), kNone);
  std::map<int, Patch> patches;
  for (std::uint32_t entity : select_surfaces(model.mesh, surfaces)) {
    try {
      const SurfaceMesh surface = read_surface(model.mesh, model.use, fixed_edges, entity, local);
      patches[model.mesh.entities[entity].tag] = whole_surface(surface);
    } catch (const SurfaceError&) {
      continue;  // nothing to measure by
    }
  }
  return patches;
}

}  // namespace qmorph
