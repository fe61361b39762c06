#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "gmsh/convert/check.hpp"
#include "gmsh/convert/periodic.hpp"
#include "gmsh/convert/replace.hpp"
#include "gmsh/model/high_order.hpp"
#include "gmsh/model/model_mesh.hpp"
#include "gmsh/model/patches.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/convert.hpp"
#include "qmorph/gmsh.hpp"

namespace qmorph {
namespace {

using namespace adapter;

/// Seconds since it was made, or since it was last asked.
class StopWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The model's mesh with every node owned by the lowest entity that uses it.
struct ReadModel {
  ModelMesh mesh;
  NodeUse use;
};

ReadModel read_model(ModelReport& report) {
  ReadModel model;
  model.mesh = read_model_mesh();
  model.use = find_node_use(model.mesh);
  if (!is_misclassified(model.mesh, model.use)) return model;

  // Gmsh's reclassification forgets nodes on points and curves that have no elements; they stay fixed all the same.
  std::vector<std::size_t> pinned_tags;
  for (Index row = 0; row < model.mesh.tags.size(); ++row)
    if (model.use.pinned[row]) pinned_tags.push_back(model.mesh.tags[row]);
  const StageLog log = run_logged([] { ::gmsh::model::mesh::reclassifyNodes(); });
  if (!log.errors.empty()) throw InputError("Gmsh cannot classify the nodes: " + first_errors(log));
  report.warnings.push_back("the file has nodes in entities that do not use them; they have been classified again");
  model.mesh = read_model_mesh();
  model.use = find_node_use(model.mesh, pinned_tags);
  return model;
}

void refuse_ghost_cells(const ModelMesh& mesh) {
  for (const EntityMesh& entity : mesh.entities)
    if (entity_type(entity.dim, entity.tag).rfind("Ghost", 0) == 0)
      throw InputError(
          fmt::format("the mesh is partitioned with ghost cells (entity {} of dimension {}); partition it "
                      "after the conversion",
                      entity.tag, entity.dim));
}

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

/// Quads of the input stay as they are, and what comes out must not have an inverted element.
void refuse_bad_quads(const SurfaceMesh& surface) {
  for (const SurfacePart& part : surface.parts)
    if (const BadQuad bad = find_bad_quad(part.patch); bad.quad != kNone)
      throw SurfaceError(fmt::format("its quad {} is inverted or not convex {}; mend it, or cut it into triangles",
                                     part.quad_tags[bad.quad], bad.where));
}

/// What is done to a surface: its triangles are converted, or its quads improved as well, or nothing.
enum class Task { convert, improve, measure };

/// The quads of a surface may change.
void free_quads(SurfaceMesh& surface) {
  surface.quads_may_go = true;
  for (SurfacePart& part : surface.parts) part.quad_tags.clear();
}

/// What is worked on as one: a surface, or surfaces that are periodic with one another, of which the first is converted and the
/// others are its images.
struct Job {
  const PeriodicFamily* family = nullptr;
  std::vector<std::uint32_t> entities{};
  std::vector<ConvertedSurface> converted{};
  std::vector<SurfaceReport> reports{};
  bool is_left_alone = false;  ///< nothing to do, or a reason not to
};

/// One run over the surfaces of a model.
class Run {
 public:
  Run(Task task, const Options& options, ModelReport& report)
      : task_(task),
        options_(options),
        report_(report),
        model_(read_model(report)),
        fixed_edges_(model_.mesh, model_.use) {
    refuse_ghost_cells(model_.mesh);
    links_ = read_periodic_links(model_.mesh);
    families_ = find_families(links_);
    common_ = find_common_elements(model_.mesh, model_.use);
    local_.assign(model_.mesh.tags.size(), kNone);
  }

  void visit(const std::vector<std::uint32_t>& entities);
  void finish();
  const ModelMesh& mesh() const { return model_.mesh; }

 private:
  SurfaceReport begin_report(std::uint32_t entity) const;
  Job begin_alone(std::uint32_t entity);
  Job begin_family(const PeriodicFamily& family, const std::vector<std::uint32_t>& entities);
  void run_engine(std::vector<Job>& jobs);
  void finish_alone(Job& job);
  void finish_family(Job& job);
  void leave_family(Job& job, std::size_t culprit, const std::string& reason) const;
  ConvertedSurface read(std::uint32_t entity);
  void accept(ConvertedSurface converted, SurfaceReport& report);
  void check(const ConvertedSurface& converted) const;
  void measure_quads(std::uint32_t entity, SurfaceReport& report);
  void restore_periodicity(const std::vector<PartTags>& part_tags);

  const Task task_;
  const Options& options_;
  ModelReport& report_;
  ReadModel model_;
  FixedEdges fixed_edges_;
  std::vector<PeriodicLink> links_;
  std::vector<PeriodicFamily> families_;
  std::map<std::uint32_t, CommonElement> common_;
  std::vector<Index> local_;
  std::vector<ConvertedSurface> converted_;
  QualityAccumulator total_;
};

SurfaceReport Run::begin_report(std::uint32_t entity) const {
  const EntityMesh& mesh = model_.mesh.entities[entity];
  SurfaceReport report;
  report.tag = mesh.tag;
  report.name = group_name(mesh.tag);
  std::tie(report.triangles_in, report.quads_in) = count_elements(mesh);
  report.triangles_out = report.triangles_in;
  report.quads_out = report.quads_in;
  return report;
}

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
  run_engine(jobs);
  for (Job& job : jobs) {
    if (!job.is_left_alone) job.family ? finish_family(job) : finish_alone(job);
    report_.surfaces.insert(report_.surfaces.end(), job.reports.begin(), job.reports.end());
  }
  std::sort(report_.surfaces.begin(), report_.surfaces.end(),
            [](const SurfaceReport& a, const SurfaceReport& b) { return a.tag < b.tag; });
}

Job Run::begin_alone(std::uint32_t entity) {
  StopWatch watch;
  Job job{.entities = {entity}, .reports = {begin_report(entity)}};
  SurfaceReport& report = job.reports[0];
  if (task_ == Task::measure || (report.triangles_in == 0 && task_ == Task::convert)) {
    measure_quads(entity, report);
    job.is_left_alone = true;
  } else {
    try {
      job.converted.push_back(read(entity));
    } catch (const SurfaceError& error) {
      report.reason = error.what();
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
        job.reports.push_back(begin_report(entity));
      }
  const std::size_t size = family.members.size();
  std::size_t at = 0;  // whose fault it is
  try {
    for (; at < size; ++at) {
      if (at >= job.entities.size() || job.reports[at].tag != family.members[at])
        throw SurfaceError("it is not to be converted, or has no elements");
      job.converted.push_back(read(job.entities[at]));
    }
    for (at = size; --at > 0;)
      match_parts(*family.link[at], model_.mesh, job.converted[family.master_of(at)].surface,
                  job.converted[at].surface);
  } catch (const SurfaceError& error) {
    leave_family(job, at, error.what());
  }
  if (!job.reports.empty()) job.reports[0].seconds = watch.lap();
  return job;
}

/// The surface `culprit` of the family has a reason to stay as it is, and the others have none but that.
void Run::leave_family(Job& job, std::size_t culprit, const std::string& reason) const {
  const int tag = job.family->members[culprit];
  job.is_left_alone = true;
  for (std::size_t i = 0; i < job.reports.size(); ++i) {
    job.reports[i] = begin_report(job.entities[i]);
    job.reports[i].reason =
        job.reports[i].tag == tag ? reason : fmt::format("it is periodic with surface {}, which stays as it is", tag);
  }
}

/// Surfaces side by side; of a family the first.
void Run::run_engine(std::vector<Job>& jobs) {
  StopWatch watch;
  std::vector<const Patch*> patches;
  for (const Job& job : jobs)
    if (!job.is_left_alone)
      for (const SurfacePart& part : job.converted[0].surface.parts) patches.push_back(&part.patch);
  const std::vector<Outcome> outcomes =
      task_ == Task::improve ? improve_all(patches, options_) : convert_all(patches, options_);
  auto outcome = outcomes.begin();
  for (Job& job : jobs) {
    if (job.is_left_alone) continue;
    std::string reason;
    for (std::size_t p = 0; p < job.converted[0].surface.parts.size(); ++p, ++outcome) {
      job.reports[0].seconds += outcome->seconds;
      if (outcome->mesh) job.converted[0].results.push_back(*outcome->mesh);
      if (reason.empty()) reason = outcome->reason;
    }
    if (reason.empty()) continue;
    if (job.family)
      leave_family(job, 0, reason);
    else
      job.reports[0].reason = reason, job.is_left_alone = true;
  }
  report_.convert_seconds += watch.lap();
}

void Run::finish_alone(Job& job) {
  StopWatch watch;
  try {
    accept(std::move(job.converted[0]), job.reports[0]);
  } catch (const SurfaceError& error) {
    job.reports[0].reason = error.what();
  }
  job.reports[0].seconds += watch.lap();
}

void Run::finish_family(Job& job) {
  StopWatch watch;
  const PeriodicFamily& family = *job.family;
  std::size_t at = 0;
  try {
    for (; at < job.converted.size(); ++at) {
      if (at > 0)
        job.converted[at].results =
            copy_results(*family.link[at], job.converted[family.master_of(at)], job.converted[at].surface, model_.mesh);
      check(job.converted[at]);
    }
    for (at = 0; at < job.converted.size(); ++at) accept(std::move(job.converted[at]), job.reports[at]);
    job.reports[0].seconds += watch.lap();
  } catch (const SurfaceError& error) {
    leave_family(job, at, error.what());
  }
}

ConvertedSurface Run::read(std::uint32_t entity) {
  if (const auto common = common_.find(entity); common != common_.end())
    throw SurfaceError(fmt::format("surface {} has the same element at {}; leave one of the two out",
                                   model_.mesh.entities[common->second.other].tag,
                                   describe_node(model_.mesh, common->second.row)));
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
    if (const std::string defect = find_defect(part.patch, converted.results[p], quads_are); !defect.empty())
      throw SurfaceError("the result is not valid: " + defect + "; this is a mistake of qmorph");
    const std::string where =
        find_bent_corner(model_.mesh, model_.mesh.entities[converted.surface.entity], part, converted.results[p]);
    if (!where.empty())
      throw SurfaceError("its curved edges would turn an element over " + where + "; refine the mesh there");
  }
}

void Run::accept(ConvertedSurface converted, SurfaceReport& report) {
  StopWatch watch;
  check(converted);
  QualityAccumulator quality;
  report.triangles_out = report.quads_out = 0;
  for (std::size_t p = 0; p < converted.results.size(); ++p) {
    const QuadMesh& result = converted.results[p];
    quality.add(converted.surface.parts[p].patch, result);
    report.triangles_out += result.triangles.size();
    report.quads_out += result.quads.size();
    report.stats.add(result.stats);
  }
  total_.add(quality);
  report.outcome = SurfaceOutcome::kConverted;
  report.warnings = converted.surface.warnings;
  report.quality = quality.result();
  converted_.push_back(std::move(converted));
  report_.check_seconds += watch.lap();
}

void Run::measure_quads(std::uint32_t entity, SurfaceReport& report) {
  report.outcome = SurfaceOutcome::kAlreadyQuads;
  SurfaceMesh surface;
  try {
    surface = read_surface(model_.mesh, model_.use, fixed_edges_, entity, local_);
  } catch (const SurfaceError& error) {
    report.reason = error.what();
    return;  // it stays as it is in any case, and there are no figures for it
  }
  if (task_ == Task::measure) {
    const std::string where = find_bent_corner(model_.mesh, model_.mesh.entities[entity]);
    if (!where.empty()) report.reason = "a curved edge turns an element over " + where;
  }
  try {
    if (task_ == Task::convert) refuse_bad_quads(surface);
  } catch (const SurfaceError& error) {
    report.outcome = SurfaceOutcome::kLeft;
    report.reason = error.what();
    return;
  }
  QualityAccumulator quality;
  for (const SurfacePart& part : surface.parts) quality.add(part.patch.points, part.patch.triangles, part.patch.quads);
  total_.add(quality);
  report.quality = quality.result();
}

void Run::finish() {
  StopWatch watch;
  report_.total = total_.result();
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
  if (!missing.empty()) throw UsageError(fmt::format("the model has no surface {}", missing.front()));
  return selected;
}

ModelReport run(Task task, const std::vector<int>& surfaces, const Options& options) {
  ModelReport report;
  const QuietErrors quiet;
  StopWatch watch;
  Run run(task, options, report);
  report.read_seconds += watch.lap();
  run.visit(select_surfaces(run.mesh(), surfaces));
  run.finish();
  return report;
}

}  // namespace

std::size_t ModelReport::count(SurfaceOutcome outcome) const {
  return static_cast<std::size_t>(std::count_if(surfaces.begin(), surfaces.end(),
                                                [outcome](const SurfaceReport& s) { return s.outcome == outcome; }));
}

ModelReport recombine(const std::vector<int>& surfaces, const Options& options) {
  return run(Task::convert, surfaces, options);
}

ModelReport measure(const std::vector<int>& surfaces) { return run(Task::measure, surfaces, {}); }

ModelReport improve_quads(const std::vector<int>& surfaces, const Options& options) {
  return run(Task::improve, surfaces, options);
}

}  // namespace qmorph
