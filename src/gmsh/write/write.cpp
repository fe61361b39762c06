// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/write/write.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/element_types.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/write/amend.hpp"
#include "gmsh/write/msh2_writer.hpp"
#include "gmsh/write/prepare.hpp"
#include "gmsh/write/staged_file.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

namespace fs = std::filesystem;

constexpr double kDefaultMshVersion = 4.1;

double choose_version(const OutputFormat& format, const OpenedModel& opened, const MshWish& wish) {
  if (format.msh_version > 0) return format.msh_version;
  if (wish.version) return *wish.version;
  const double option = get_option("Mesh.MshFileVersion");  // a script may have set it
  if (option < 1 || option > kDefaultMshVersion)
    throw OutputError(fmt::format("Mesh.MshFileVersion = {:g}: there is no such version of MSH", option));
  if (option != kDefaultMshVersion) return option;
  if (opened.msh.version == 0) return kDefaultMshVersion;
  return opened.msh.version >= 2 && opened.msh.version < 3 ? 2.2 : opened.msh.version;
}

/// Entities that have elements but no physical group; the old formats leave them out if there is any group at all.
::gmsh::vectorpair ungrouped_entities() {
  ::gmsh::vectorpair entities, ungrouped;
  ::gmsh::model::getEntities(entities);
  for (const auto& [dim, tag] : entities) {
    std::vector<int> groups, types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    ::gmsh::model::getPhysicalGroupsForEntity(dim, tag, groups);
    if (!groups.empty()) continue;
    ::gmsh::model::mesh::getElements(types, tags, nodes, dim, tag);
    if (!types.empty()) ungrouped.emplace_back(dim, tag);
  }
  return ungrouped;
}

/// Puts what is in no group into group 0, as long as this lives. Before version 4, Mesh.SaveAll = 1 drops the groups,
/// and 0 drops what is in none; group 0 is what these formats write, and read, as "none".
class GroupZero {
 public:
  GroupZero() {
    std::map<int, std::vector<int>> tags;
    for (const auto& [dim, tag] : ungrouped_entities()) tags[dim].push_back(tag);
    for (const auto& [dim, entities] : tags) {
      ::gmsh::model::addPhysicalGroup(dim, entities, 0);
      groups_.emplace_back(dim, 0);
    }
  }
  ~GroupZero() {
    if (!groups_.empty()) ::gmsh::model::removePhysicalGroups(groups_);
  }
  GroupZero(const GroupZero&) = delete;
  GroupZero& operator=(const GroupZero&) = delete;

 private:
  ::gmsh::vectorpair groups_;
};

bool has_groups() {
  ::gmsh::vectorpair groups;
  ::gmsh::model::getPhysicalGroups(groups);
  return !groups.empty();
}

/// Whether our own writer is used, which keeps tags and partitions.
bool keeps_tags_of_msh2(double version, const OpenedModel& opened) {
  return version == 2.2 && (opened.msh.is_2() || !opened.views.steps.empty());
}

/// Where there are groups, Gmsh leaves out what is in none. But a mesh that was read is expected to come out whole
/// where the format allows it, as MSH does.
bool leaves_out_ungrouped(const OutputPlan& plan, const OpenedModel& opened, const MshWish& wish) {
  if (!has_groups() || get_option("Mesh.SaveAll") != 0) return false;
  const bool keeps_all = plan.for_reader || plan.format.is_msh;
  if (keeps_all && opened.msh.version != 0) return false;
  return plan.for_reader || !plan.format.is_msh ||
         !keeps_tags_of_msh2(choose_version(plan.format, opened, wish), opened);
}

bool holds_views(double version) { return version == 2.2 || version >= 4; }

void write_msh(const std::string& path, double version, bool everything) {
  const ScopedOption version_option("Mesh.MshFileVersion", version);
  if (!everything || !has_groups()) {
    ::gmsh::write(path);
  } else if (version >= 4) {
    const ScopedOption save_all("Mesh.SaveAll", 1);
    ::gmsh::write(path);
  } else {
    const ScopedOption save_all("Mesh.SaveAll", 0);
    const GroupZero rest;
    ::gmsh::write(path);
  }
}

/// Writes a format other than MSH.
void write_other(const OutputPlan& plan, const std::string& path) {
  std::vector<int> types;
  ::gmsh::model::mesh::getElementTypes(types, 2);
  const bool is_second =
      std::any_of(types.begin(), types.end(), [](int type) { return element_type(type).order == 2; });
  const int order = is_second ? 2 : 1;
  {
    const ScopedOption order_option("Mesh.ElementOrder", order);  // from this the writer knows the order
    ::gmsh::write(path);
  }
  amend(path, plan.path, plan.format, order);
}

bool has_elements_of(int type, int dim) {
  std::vector<int> types;
  ::gmsh::model::mesh::getElementTypes(types, dim);
  return std::count(types.begin(), types.end(), type) > 0;
}

}  // namespace

OutputPlan plan_output(const std::string& input, const std::string& output, const std::string& format) {
  OutputPlan plan;
  const bool by_name = !format.empty() && format != "auto";
  if (by_name) plan.format = format_by_name(format);
  if (!output.empty()) {
    plan.path = output;
    if (!by_name) plan.format = format_by_extension(output);
  } else {
    if (!by_name) plan.format = format_by_name("msh");
    plan.path = fs::path(input).replace_extension(default_extension(plan.format)).string();
  }
  plan.name = plan.path;
  check_place(plan.path);
  return plan;
}

StagedFile stage(const OutputPlan& plan, TemporaryNames* names) {
  return StagedFile(plan.path, plan.format.is_msh ? ".msh" : plan.format.extension, names);
}

void check_format(const OutputPlan& plan, TemporaryNames* names) {
  const StagedFile probe = stage(plan, names);
  const StageLog log = run_logged([&] { ::gmsh::write(probe.path()); });
  for (std::string error : log.errors) {
    if (error.find("nknown") == std::string::npos && error.find("ompiled without") == std::string::npos &&
        error.find("must be compiled with") == std::string::npos)
      continue;
    if (const std::size_t at = error.find(probe.path()); at != std::string::npos)
      error.replace(at, probe.path().size(), plan.name);
    throw OutputError(
        fmt::format("cannot write {}: this Gmsh has no format {} ({})", plan.name, plan.format.name, error));
  }
}

void check_elements(const OutputPlan& plan, int order) {
  constexpr int kLine3 = 8, kQuad8 = 16;
  const auto refuse = [&](const std::string& why) {
    throw OutputError(fmt::format("cannot write {}: {}", plan.name, why));
  };
  if (order > plan.format.max_order)
    refuse(fmt::format("the readers of {} know elements up to order {} only, and the mesh has order {} (-order {})",
                       plan.format.name, plan.format.max_order, order, plan.format.max_order));
  if (order == 2 && plan.format.quad_nodes == 9 && has_elements_of(kQuad8, 2))
    refuse(
        fmt::format("the format {} has quads with 9 nodes for order 2, and the mesh has some with 8 "
                    "(-setnumber Mesh.SecondOrderIncomplete 0, or -order 1)",
                    plan.format.name));
  if (order == 2 && plan.format.name == "bdf" && has_elements_of(kLine3, 1) && !has_groups())
    refuse("the format bdf has no lines of order 2; put only the surfaces into physical groups, or use -order 1");
}

void prepare_for_format(const OutputPlan& plan) {
  if (plan.format.quad_nodes == 8) drop_middle_nodes();
  if (plan.format.name == "su2") drop_loose_points();  // it expects every node to belong to an element
  if (plan.format.name != "diff") return;
  // Gmsh's writer uses the numbers of nodes as indices into an array that is only as long as there are nodes.
  run_logged([] { ::gmsh::model::mesh::reclassifyNodes(); });
  renumber();
}

void renumber() {
  run_logged([] {
    ::gmsh::model::mesh::renumberNodes();
    ::gmsh::model::mesh::renumberElements();
  });
}

std::vector<std::string> describe_unwritten(const OutputPlan& plan, const OpenedModel& opened, const MshWish& wish) {
  std::vector<std::string> lines = opened.views.warnings;
  const bool has_place =
      plan.format.is_msh && !plan.for_reader && holds_views(choose_version(plan.format, opened, wish));
  if (!opened.views.steps.empty() && !has_place)
    lines.push_back(
        fmt::format("data on nodes and elements (views) is not written to {}; MSH 2.2 and 4 keep it, "
                    "without --for",
                    plan.name));
  if (const std::vector<int> surfaces = find_unwritten_surfaces(plan, opened, wish); !surfaces.empty())
    lines.push_back(
        fmt::format("surfaces in no physical group are not written to {}: {} (-setnumber Mesh.SaveAll 1 writes all)",
                    plan.name, fmt::join(surfaces, ", ")));
  return lines;
}

std::vector<int> find_unwritten_surfaces(const OutputPlan& plan, const OpenedModel& opened, const MshWish& wish) {
  std::vector<int> surfaces;
  if (!leaves_out_ungrouped(plan, opened, wish)) return surfaces;
  for (const auto& [dim, tag] : ungrouped_entities())
    if (dim == 2) surfaces.push_back(tag);
  return surfaces;
}

bool leaves_out_every_surface(const OutputPlan& plan, const OpenedModel& opened, const MshWish& wish) {
  const std::vector<int> unwritten = find_unwritten_surfaces(plan, opened, wish);
  ::gmsh::vectorpair surfaces;
  ::gmsh::model::getEntities(surfaces, 2);
  return !unwritten.empty() && std::none_of(surfaces.begin(), surfaces.end(), [&](const auto& surface) {
    return std::count(unwritten.begin(), unwritten.end(), surface.second) == 0 && has_elements(2, surface.second);
  });
}

bool only_volumes_are_grouped(const OutputPlan& plan, const OpenedModel& opened, const MshWish& wish) {
  ::gmsh::vectorpair of_surfaces, of_volumes;
  ::gmsh::model::getPhysicalGroups(of_surfaces, 2);
  ::gmsh::model::getPhysicalGroups(of_volumes, 3);
  return of_surfaces.empty() && !of_volumes.empty() && leaves_out_ungrouped(plan, opened, wish);
}

void write_model(const OutputPlan& plan, const OpenedModel& opened, const MshWish& wish, StagedFile& file) {
  const bool keep_encoding = plan.format.is_msh && opened.msh.version != 0;
  const bool binary = wish.binary.value_or(keep_encoding ? opened.msh.binary : get_option("Mesh.Binary") != 0);
  const ScopedOption binary_option("Mesh.Binary", binary);
  const double version = plan.format.is_msh ? choose_version(plan.format, opened, wish) : 0;
  const StageLog log = run_logged([&] {
    if (keeps_tags_of_msh2(version, opened))
      write_msh2(file.path(), binary, opened.origin);
    else if (plan.format.is_msh)
      write_msh(file.path(), version, opened.msh.version != 0 || get_option("Mesh.SaveAll") != 0);
    else
      write_other(plan, file.path());
  });
  if (!log.errors.empty()) throw OutputError(fmt::format("cannot write {}: {}", plan.path, first_errors(log)));
  if (holds_views(version))
    append_views(file.path(), binary, opened.carried ? *opened.carried : carry_over(opened.views));
  if (plan.format.is_msh) check_msh_end(file.path(), plan.path);
}

void copy_input(const std::string& input, const OutputPlan& plan, StagedFile& file) {
  std::error_code error;
  fs::copy_file(input, file.path(), fs::copy_options::overwrite_existing, error);
  if (error) throw OutputError(fmt::format("cannot write {}: {}", plan.path, error.message()));
}

}  // namespace qmorph::adapter
