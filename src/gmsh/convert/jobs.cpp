// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/convert/jobs.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "gmsh/session/compat.hpp"
#include "qmorph/observer.hpp"

namespace qmorph::adapter {
namespace {

std::string group_name(int surface) {
  std::vector<int> groups;
  ::gmsh::model::getPhysicalGroupsForEntity(2, surface, groups);
  std::string name;
  if (!groups.empty()) ::gmsh::model::getPhysicalName(2, groups.front(), name);
  return name;
}

/// Triangles and quads of an entity, of any order.
std::pair<std::size_t, std::size_t> count_elements(const EntityMesh& entity) {
  std::size_t triangles = 0, quads = 0;
  if (const ElementBlock* block = entity.polygons(3)) triangles = block->tags.size();
  if (const ElementBlock* block = entity.polygons(4)) quads = block->tags.size();
  return {triangles, quads};
}

/// Tells an observer of tags where the engine speaks of patches.
class TagObserver : public Observer {
 public:
  /// `tags`: the surface of each patch.
  TagObserver(Observer& observer, std::vector<int> tags) : observer_(observer), tags_(std::move(tags)) {}
  std::unique_ptr<FrontObserver> front_starts(const FrontStart& start) override {
    FrontStart tagged = start;
    tagged.surface = tag(start.surface);
    return observer_.front_starts(tagged);
  }
  void front_kept(std::size_t surface, std::unique_ptr<FrontObserver> front) override {
    observer_.front_kept(tag(surface), std::move(front));
  }
  bool wants_stages() const override { return observer_.wants_stages(); }
  void stage_done(const StageView& view) override {
    StageView tagged = view;
    tagged.surface = tag(view.surface);
    observer_.stage_done(tagged);
  }

 private:
  std::size_t tag(std::size_t patch) const { return std::size_t(tags_[patch]); }

  Observer& observer_;
  std::vector<int> tags_;
};

/// Translates what the engine says about rows into tags of the model.
SurfaceError in_tags(const SurfaceError& error, const ModelMesh& mesh, const SurfacePart& part) {
  ErrorDetails details = error.details();
  if (details.subject && details.subject->kind == ErrorSubject::Kind::node) {
    const std::size_t row = details.subject->number;
    if (row < part.rows.size())
      details.subject->number = mesh.tags[part.rows[row]];
    else
      details.subject.reset();
  }
  return SurfaceError(error.what(), details);
}

std::vector<Outcome> run(const std::vector<Job>& jobs, Engine engine, Options options) {
  std::vector<const Patch*> patches;
  std::vector<int> tags;
  for (const Job& job : jobs)
    if (!job.is_left_alone)
      for (const SurfacePart& part : job.converted[0].surface.parts)
        patches.push_back(&part.patch), tags.push_back(job.reports[0].tag);
  std::optional<TagObserver> observer;
  if (options.observer) options.observer = &observer.emplace(*options.observer, std::move(tags));
  return engine(patches, options);
}

}  // namespace

ErrorSubject surface_tag(int tag) { return {ErrorSubject::Kind::surface, std::size_t(tag)}; }

SurfaceReport begin_report(const ModelMesh& model, std::uint32_t entity) {
  const EntityMesh& mesh = model.entities[entity];
  SurfaceReport report;
  report.tag = mesh.tag;
  report.name = group_name(mesh.tag);
  std::tie(report.triangles_in, report.quads_in) = count_elements(mesh);
  report.triangles_out = report.triangles_in;
  report.quads_out = report.quads_in;
  return report;
}

void leave(SurfaceReport& report, const SurfaceError& error) {
  report.outcome = SurfaceOutcome::left;
  report.reason = error.what();
  report.error = error.details();
}

void leave_family(Job& job, std::size_t culprit, const SurfaceError& error, const ModelMesh& mesh) {
  const int tag = job.family->members[culprit];
  const bool extruded = job.family->link.back()->is_extrusion;
  const SurfaceError of_others(
      fmt::format("it is {} surface {}, which stays as it is", extruded ? "extruded with" : "periodic with", tag),
      {.kind = ErrorKind::periodic, .subject = surface_tag(tag)});
  job.is_left_alone = true;
  for (std::size_t i = 0; i < job.reports.size(); ++i) {
    job.reports[i] = begin_report(mesh, job.entities[i]);
    leave(job.reports[i], job.reports[i].tag == tag ? error : of_others);
  }
}

void run_engine(std::vector<Job>& jobs, Engine engine, const Options& options, const ModelMesh& mesh) {
  std::vector<Outcome> outcomes = run(jobs, engine, options);
  auto outcome = outcomes.begin();
  for (Job& job : jobs) {
    if (job.is_left_alone) continue;
    std::optional<SurfaceError> error;
    ConvertedSurface& converted = job.converted[0];
    for (std::size_t p = 0; p < converted.surface.parts.size(); ++p, ++outcome) {
      job.reports[0].seconds += outcome->seconds;
      if (outcome->conversion) {
        converted.report.add(outcome->conversion->report);
        converted.results.push_back(std::move(outcome->conversion->mesh));
      } else if (!error) {
        error = in_tags(*outcome->error, mesh, converted.surface.parts[p]);
      }
    }
    if (!error) continue;
    if (job.family)
      leave_family(job, 0, *error, mesh);
    else
      leave(job.reports[0], *error), job.is_left_alone = true;
  }
}

}  // namespace qmorph::adapter
