#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "gmsh/check.hpp"
#include "gmsh/compat.hpp"
#include "gmsh/high_order.hpp"
#include "gmsh/model_mesh.hpp"
#include "gmsh/patches.hpp"
#include "gmsh/periodic.hpp"
#include "gmsh/replace.hpp"
#include "gmsh/session.hpp"
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
  void convert_alone(std::uint32_t entity);
  void convert_family(const PeriodicFamily& family, const std::vector<std::uint32_t>& entities);
  ConvertedSurface read(std::uint32_t entity);
  void run_engine(ConvertedSurface& converted);
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
  std::set<int> done;
  for (std::uint32_t entity : entities) {
    const int tag = model_.mesh.entities[entity].tag;
    if (!done.insert(tag).second) continue;
    const auto family = std::find_if(families_.begin(), families_.end(), [&](const PeriodicFamily& candidate) {
      return std::count(candidate.members.begin(), candidate.members.end(), tag);
    });
    if (family == families_.end() || task_ == Task::measure) {
      convert_alone(entity);
    } else {
      convert_family(*family, entities);
      done.insert(family->members.begin(), family->members.end());
    }
  }
  std::sort(report_.surfaces.begin(), report_.surfaces.end(),
            [](const SurfaceReport& a, const SurfaceReport& b) { return a.tag < b.tag; });
}

void Run::convert_alone(std::uint32_t entity) {
  StopWatch watch;
  SurfaceReport report = begin_report(entity);
  if (task_ == Task::measure || (report.triangles_in == 0 && task_ == Task::convert)) {
    measure_quads(entity, report);
  } else {
    try {
      ConvertedSurface converted = read(entity);
      run_engine(converted);
      accept(std::move(converted), report);
    } catch (const SurfaceError& error) {
      report.reason = error.what();
    }
  }
  report.seconds = watch.lap();
  report_.surfaces.push_back(std::move(report));
}

/// One surface is converted and the others are its images; all of them or none.
void Run::convert_family(const PeriodicFamily& family, const std::vector<std::uint32_t>& entities) {
  StopWatch watch;
  std::vector<SurfaceReport> reports;
  std::vector<ConvertedSurface> converted(family.members.size());
  int at = 0;  // whose fault it is
  try {
    for (std::size_t i = 0; i < family.members.size(); ++i) {
      at = family.members[i];
      const auto entity = std::find_if(entities.begin(), entities.end(),
                                       [&](std::uint32_t e) { return model_.mesh.entities[e].tag == at; });
      if (entity == entities.end()) throw SurfaceError("it is not to be converted, or has no elements");
      reports.push_back(begin_report(*entity));
      converted[i] = read(*entity);
    }
    const auto master = [&](std::size_t i) -> ConvertedSurface& {
      const auto found = std::find(family.members.begin(), family.members.end(), family.link[i]->master);
      return converted[static_cast<std::size_t>(found - family.members.begin())];
    };
    for (std::size_t i = family.members.size(); --i > 0;) {
      at = family.members[i];
      match_parts(*family.link[i], model_.mesh, master(i).surface, converted[i].surface);
    }
    run_engine(converted[0]);
    for (std::size_t i = 0; i < converted.size(); ++i) {
      at = family.members[i];
      if (i > 0) converted[i].results = copy_results(*family.link[i], master(i), converted[i].surface, model_.mesh);
      check(converted[i]);
    }
    for (std::size_t i = 0; i < converted.size(); ++i) accept(std::move(converted[i]), reports[i]);
    reports[0].seconds = watch.lap();
  } catch (const SurfaceError& error) {
    reports.clear();
    for (std::uint32_t entity : entities) {
      SurfaceReport report = begin_report(entity);
      if (!std::count(family.members.begin(), family.members.end(), report.tag)) continue;
      report.reason =
          report.tag == at ? error.what() : fmt::format("it is periodic with surface {}, which stays as it is", at);
      reports.push_back(std::move(report));
    }
  }
  report_.surfaces.insert(report_.surfaces.end(), reports.begin(), reports.end());
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

void Run::run_engine(ConvertedSurface& converted) {
  StopWatch watch;
  for (const SurfacePart& part : converted.surface.parts)
    converted.results.push_back(task_ == Task::convert ? convert(part.patch, options_) : improve(part.patch, options_));
  report_.convert_seconds += watch.lap();
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
    const Eigen::Vector3d normal = patch_normal(converted.surface.parts[p].patch);
    for (QualityAccumulator* figures : {&quality, &total_})
      figures->add(result.points, result.triangles, result.quads, normal);
    report.triangles_out += result.triangles.size();
    report.quads_out += result.quads.size();
    report.stats.add(result.stats);
  }
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
  for (const SurfacePart& part : surface.parts) {
    for (QualityAccumulator* figures : {&quality, &total_})
      figures->add(part.patch.points, part.patch.triangles, part.patch.quads);
  }
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
