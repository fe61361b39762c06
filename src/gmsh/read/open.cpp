// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/open.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>

#include "gmsh/read/dialect.hpp"
#include "gmsh/read/groups.hpp"
#include "gmsh/read/guest_model.hpp"
#include "gmsh/read/merge.hpp"
#include "gmsh/read/meshing.hpp"
#include "gmsh/read/msh/msh2_text.hpp"
#include "gmsh/read/readable.hpp"
#include "gmsh/read/sources.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/scratch_file.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

namespace fs = std::filesystem;

/// With more than this in a file without $Entities, reading it again for each would take too long.
constexpr std::size_t kUndeclaredEntities = 256;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// An entity in several physical groups, and how many. In files before MSH 4 each element has its own.
std::optional<std::pair<std::pair<int, int>, std::size_t>> mixed_entity(const Msh2Origin& origin) {
  ::gmsh::vectorpair entities;
  ::gmsh::model::getEntities(entities);
  for (const auto& [dim, tag] : entities) {
    std::vector<int> groups;
    ::gmsh::model::getPhysicalGroupsForEntity(dim, tag, groups);
    if (groups.size() > 1 && !origin.more_groups.count({dim, tag})) return {{{dim, tag}, groups.size()}};
  }
  return std::nullopt;
}

/// For files of MSH 1 and 3, which are not taken apart (msh2_groups.hpp).
void refuse_mixed_groups(const MshHeader& header, const Msh2Origin& origin) {
  if (header.version == 0 || header.version >= 4) return;
  if (const auto mixed = mixed_entity(origin))
    throw InputError(
        fmt::format("elements with elementary tag {} (dimension {}) are in {} physical groups, which Gmsh cannot keep "
                    "apart; give each group its own elementary tag, or write the file as MSH 2.2 or 4.1",
                    mixed->first.second, mixed->first.first, mixed->second));
}

void add_groups(const Msh2Origin& origin) {
  std::map<std::pair<int, int>, std::vector<int>> members;
  for (const auto& [entity, groups] : origin.more_groups)
    for (int group : groups) members[{entity.first, group}].push_back(entity.second);
  for (const auto& [group, entities] : members) add_to_group(group.first, group.second, entities);
}

/// Gmsh keeps one of several elements that have the same number, and says nothing. Partitions add some.
void check_element_count(const std::string& path, const MshContents& contents, const Msh2Origin& origin) {
  if (!contents.elements) return;
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  ::gmsh::model::mesh::getElements(types, tags, nodes);
  std::size_t count = 0;
  for (const auto& block : tags) count += block.size();
  for (const auto& [element, copies] : origin.copies) count += copies.size();
  if (count < *contents.elements)
    throw InputError(fmt::format("{} has {} elements, and only {} numbers for them; renumber the elements", path,
                                 *contents.elements, count));
}

void set_group_name(const GroupName& group) {
  std::string now;
  ::gmsh::model::getPhysicalName(group.dim, group.tag, now);
  if (!now.empty()) ::gmsh::model::removePhysicalName(now);
  ::gmsh::model::setPhysicalName(group.dim, group.tag, group.name);
}

/// "Unknown entity 7 of dimension 1": what a file without $Entities makes Gmsh say when elements are on an entity
/// that no node is on. \return dimension and tag
std::optional<std::pair<int, int>> unknown_entity(const StageLog& log) {
  static const std::regex complaint(R"(Unknown entity (\d+) of dimension (\d+))");
  for (const std::string& error : log.errors) {
    std::smatch match;
    if (std::regex_search(error, match, complaint)) return std::pair(std::stoi(match[2]), std::stoi(match[1]));
  }
  return std::nullopt;
}

/// Opens a file. Entities that it uses and does not declare are made first, one more with each attempt.
StageLog open_file(const std::string& path) {
  StageLog log = run_logged([&] { ::gmsh::open(path); });
  std::vector<std::pair<int, int>> entities;
  while (entities.size() < kUndeclaredEntities) {
    const auto missing = unknown_entity(log);
    if (!missing || std::count(entities.begin(), entities.end(), *missing)) break;
    entities.push_back(*missing);
    log = run_logged([&] {
      ::gmsh::clear();
      ::gmsh::model::add(fs::path(path).stem().string());
      for (const auto& [dim, tag] : entities) ::gmsh::model::addDiscreteEntity(dim, tag);
      ::gmsh::merge(path);
    });
  }
  return log;
}

/// Opens a file of MSH 2, taken apart if one elementary tag is in several groups. Binary files are looked into only if
/// Gmsh has found such a tag, and as text.
StageLog open_msh2(const std::string& path, bool binary, Msh2Origin& origin) {
  const bool may_part = get_option("Mesh.SwitchElementTags") == 0;
  const ScratchFile text(".msh"), rewritten(".msh");
  StageLog log;
  if (binary) log = open_file(path);
  if (binary && (!may_part || !log.errors.empty() || !mixed_entity(origin))) return log;
  if (binary) {
    write_msh2_as_text(path, text.path());
    ::gmsh::clear();
  }
  const std::string& source = binary ? text.path() : path;
  if (may_part) origin = separate_groups(source, rewritten.path());
  return open_file(origin.empty() ? source : rewritten.path());
}

/// Most of Gmsh's readers say nothing where they find nothing.
void check_not_empty(const std::string& path) {
  if (!is_mesh_file(path) && !is_cad_file(path)) return;  // a script may be about something else
  ::gmsh::vectorpair entities;
  std::vector<int> views;
  ::gmsh::model::getEntities(entities);
  ::gmsh::view::getTags(views);
  if (entities.empty() && views.empty())
    throw InputError(
        fmt::format("{} cannot be opened: Gmsh finds nothing in it; is it of the format that its name says?{}", path,
                    describe_dialect(path)));
}

/// What Gmsh says. A format that it only writes it takes for a script; words that it does not know are often those of
/// another version, as names of fields are.
std::string why_not_opened(const std::string& path, const StageLog& log) {
  const std::string said = first_errors(log);
  std::string version;
  ::gmsh::option::getString("General.Version", version);
  // Not one in the file of options beside it.
  const std::string place = fs::path(path).filename().string() + "', line ";
  if (!is_script(path) && said.find("syntax error") != std::string::npos && said.find(place) != std::string::npos)
    return fmt::format(
        "Gmsh {} takes it for a script, since it does not read {} files; convert it to .msh, .vtk or .bdf", version,
        fs::path(path).extension().string());
  if (said.find("Unknown ") != std::string::npos) return fmt::format("{} (this is Gmsh {})", said, version);
  return said + describe_dialect(path);
}

/// What -bgm does in Gmsh's own command.
void set_background(const std::string& path) {
  check_readable(path);
  std::vector<int> before, views;
  ::gmsh::view::getTags(before);
  const ScratchFile script(".geo");
  StageLog log = run_logged([&] { ::gmsh::merge(path); });
  ::gmsh::view::getTags(views);
  if (views.size() == before.size()) throw InputError(fmt::format("-bgm: there is no view in {}", path));
  std::ofstream(script.path()) << "Background Mesh View[" << views.size() - 1 << "];\n";
  if (log.errors.empty()) log = run_logged([&] { ::gmsh::merge(script.path()); });
  if (!log.errors.empty()) throw InputError(fmt::format("-bgm {}: {}", path, first_errors(log)));
}

}  // namespace

OpenedModel open_model(const std::string& path, const OpenOptions& options) {
  check_readable(path);
  OpenedModel opened;
  opened.msh = read_msh_header(path);
  MshContents contents;
  if (opened.msh.version != 0) contents = check_msh_file(path, opened.msh);
  if (!options.ignore_periodicity) set_option("Mesh.IgnorePeriodicity", 0);  // MSH 2 would lose it

  auto start = std::chrono::steady_clock::now();
  const StageLog log = opened.msh.is_2() ? open_msh2(path, opened.msh.binary, opened.origin) : open_file(path);
  if (!log.errors.empty()) throw InputError(fmt::format("{} cannot be opened: {}", path, why_not_opened(path, log)));
  std::vector<ViewStep> merged_data;
  for (const std::string& file : options.merged) {
    const std::vector<ViewStep> data = merge_file(file);
    merged_data.insert(merged_data.end(), data.begin(), data.end());
  }
  if (!options.merged.empty()) check_geometry_kept();
  if (!options.background.empty()) set_background(options.background);
  take_control();
  if (opened.msh.version != 0) place_nodes_as_in(path);
  check_element_count(path, contents, opened.origin);
  add_groups(opened.origin);
  refuse_mixed_groups(opened.msh, opened.origin);
  for (const GroupName& group : contents.odd_names) set_group_name(group);
  if (opened.msh.version == 0) check_not_empty(path);
  opened.warnings = log.warnings;
  opened.sources = files_read(log);
  opened.open_seconds = seconds_since(start);
  if (options.when_read) options.when_read();

  std::vector<std::string> scripts = opened.sources;
  scripts.push_back(path);
  opened.compounds = name_compounds(scripts);
  MeshingTask task = find_meshing_task(opened.msh.version != 0);
  task.compounds = opened.compounds;
  task.becomes_layers = options.becomes_layers;
  opened.had_mesh = opened.msh.version != 0 || !task.kept.empty();
  if (opened.had_mesh) opened.views = read_views(merged_data);  // else they say what size elements are to have
  if (task.is_empty() || options.no_meshing) return opened;
  start = std::chrono::steady_clock::now();
  MeshedModel meshed = mesh_surfaces(task, options.keep_curves);
  opened.warnings.insert(opened.warnings.end(), meshed.warnings.begin(), meshed.warnings.end());
  opened.division = std::move(meshed.division);
  opened.even = std::move(meshed.even);
  opened.meshed = true;
  opened.mesh_seconds = seconds_since(start);
  return opened;
}

}  // namespace qmorph::adapter
