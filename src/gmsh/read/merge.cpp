// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/merge.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "geometry/describe.hpp"
#include "gmsh/model/model_mesh.hpp"
#include "gmsh/model/periodic_links.hpp"
#include "gmsh/read/groups.hpp"
#include "gmsh/read/guest_model.hpp"
#include "gmsh/read/msh/file.hpp"
#include "gmsh/read/readable.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/element_types.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

/// The mesh of a file that is to be merged, and what hangs on its entities.
struct Guest {
  ModelMesh mesh;
  std::vector<std::vector<int>> boundary;  ///< of each entity, with signs
  std::vector<PhysicalGroup> groups;
  std::vector<PeriodicLink> links;
  std::vector<ViewStep> data;
  bool partitioned = false;
};

/// What is added to its numbers.
struct Shift {
  std::size_t node = 0, element = 0;
  std::array<int, 4> entity{};
};

Guest read_guest() {
  Guest guest;
  guest.mesh = read_model_mesh();
  for (const EntityMesh& entity : guest.mesh.entities) {
    ::gmsh::vectorpair sides;
    if (entity.dim > 0) ::gmsh::model::getBoundary({{entity.dim, entity.tag}}, sides, false, true);
    guest.boundary.emplace_back();
    for (const auto& side : sides) guest.boundary.back().push_back(side.second);
  }
  guest.groups = read_physical_groups();
  for (const EntityMesh& entity : guest.mesh.entities) {
    std::vector<int> partitions;
    ::gmsh::model::getPartitions(entity.dim, entity.tag, partitions);
    guest.partitioned = guest.partitioned || !partitions.empty();
  }
  for (int dim : {0, 1, 2}) {
    const std::vector<PeriodicLink> links = read_periodic_links(guest.mesh, dim);
    guest.links.insert(guest.links.end(), links.begin(), links.end());
  }
  return guest;
}

/// Reads a file into a model of its own, which is gone afterwards, with what hangs on it.
Guest read_alone(const std::string& path) {
  Guest guest;
  const GuestModel model;
  const StageLog log = run_logged([&] {
    ::gmsh::merge(path);
    place_nodes_as_in(path);
    guest = read_guest();
    guest.data = read_steps(model.views_before()).steps;
  });
  if (!log.errors.empty()) throw InputError(fmt::format("{} cannot be merged: {}", path, first_errors(log)));
  return guest;
}

enum class Common { nothing, same, different };

Common common_nodes(const ModelMesh& host, const ModelMesh& guest) {
  Common common = Common::nothing;
  for (Index row = 0; row < guest.tags.size(); ++row) {
    const Index other = host.rows.find(guest.tags[row]);
    if (other == kNone) continue;
    if (host.points[other] != guest.points[row]) return Common::different;
    common = Common::same;
  }
  return common;
}

/// Elements by number: their nodes.
using Elements = std::unordered_map<std::size_t, std::vector<std::size_t>>;

Elements list_elements(const ModelMesh& mesh) {
  Elements elements;
  for (const EntityMesh& entity : mesh.entities)
    for (const ElementBlock& block : entity.blocks)
      for (std::size_t e = 0; e < block.tags.size(); ++e) {
        const auto first = block.nodes.begin() + std::ptrdiff_t(e * block.nodes_per_element);
        elements[block.tags[e]].assign(first, first + std::ptrdiff_t(block.nodes_per_element));
      }
  return elements;
}

Common common_elements(const Elements& host, const ModelMesh& guest) {
  Common common = Common::nothing;
  for (const auto& [tag, nodes] : list_elements(guest)) {
    const auto found = host.find(tag);
    if (found == host.end()) continue;
    if (found->second != nodes) return Common::different;
    common = Common::same;
  }
  return common;
}

/// An entity that has elements in both, and is in other groups in each.
bool have_common_entities(const ModelMesh& host, const Guest& guest) {
  std::set<std::pair<int, int>> with_elements;
  for (const EntityMesh& entity : host.entities)
    if (entity.element_count()) with_elements.insert({entity.dim, entity.tag});
  return std::any_of(guest.mesh.entities.begin(), guest.mesh.entities.end(), [&](const EntityMesh& entity) {
    if (!entity.element_count() || !with_elements.count({entity.dim, entity.tag})) return false;
    std::vector<int> groups, theirs;
    ::gmsh::model::getPhysicalGroupsForEntity(entity.dim, entity.tag, groups);
    for (const PhysicalGroup& group : guest.groups)
      if (group.dim == entity.dim && std::count(group.entities.begin(), group.entities.end(), entity.tag))
        theirs.push_back(group.tag);
    std::sort(groups.begin(), groups.end());
    return groups != theirs;
  });
}

/// \return nothing where Gmsh's own merging does
std::optional<Shift> find_shift(const ModelMesh& host, const Elements& host_elements, const Guest& guest) {
  const Common nodes = common_nodes(host, guest.mesh), elements = common_elements(host_elements, guest.mesh);
  const bool entities = elements != Common::same && have_common_entities(host, guest);
  if (nodes == Common::nothing && elements == Common::nothing && !entities) return std::nullopt;
  Shift shift;
  if (nodes == Common::different) shift.node = host.max_node_tag;
  if (shift.node || elements == Common::different) shift.element = host.max_element_tag;
  if (!shift.node && !entities) return shift;
  for (const EntityMesh& entity : host.entities) {
    int& most = shift.entity[std::size_t(entity.dim)];
    most = std::max(most, entity.tag);
  }
  return shift;
}

void add_entities(const ModelMesh& host, const Guest& guest, const Shift& shift) {
  std::set<std::pair<int, int>> known;
  for (const EntityMesh& entity : host.entities) known.insert({entity.dim, entity.tag});
  for (std::size_t e = 0; e < guest.mesh.entities.size(); ++e) {
    const EntityMesh& entity = guest.mesh.entities[e];
    const int tag = entity.tag + shift.entity[std::size_t(entity.dim)];
    if (!known.insert({entity.dim, tag}).second) continue;
    std::vector<int> boundary = guest.boundary[e];
    for (int& side : boundary) side += (side < 0 ? -1 : 1) * shift.entity[std::size_t(entity.dim - 1)];
    ::gmsh::model::addDiscreteEntity(entity.dim, tag, boundary);
    if (entity.dim == 0 && !entity.xyz.empty())
      ::gmsh::model::setCoordinates(tag, entity.xyz[0], entity.xyz[1], entity.xyz[2]);
  }
}

void add_nodes(const ModelMesh& host, const EntityMesh& entity, const Shift& shift) {
  EntityMesh added;
  for (std::size_t i = 0; i < entity.node_tags.size(); ++i) {
    const std::size_t tag = entity.node_tags[i] + shift.node;
    if (host.rows.find(tag) != kNone) continue;
    added.node_tags.push_back(tag);
    added.xyz.insert(added.xyz.end(), &entity.xyz[3 * i], &entity.xyz[3 * i] + 3);
  }
  if (!added.node_tags.empty())
    ::gmsh::model::mesh::addNodes(entity.dim, entity.tag + shift.entity[std::size_t(entity.dim)], added.node_tags,
                                  added.xyz);
}

void add_elements(const Elements& host, const EntityMesh& entity, const Shift& shift) {
  for (const ElementBlock& block : entity.blocks) {
    std::vector<std::size_t> tags, nodes;
    for (std::size_t e = 0; e < block.tags.size(); ++e) {
      const std::size_t tag = block.tags[e] + shift.element;
      if (host.count(tag)) continue;
      tags.push_back(tag);
      for (std::size_t k = 0; k < block.nodes_per_element; ++k)
        nodes.push_back(block.nodes[e * block.nodes_per_element + k] + shift.node);
    }
    const int owner = entity.tag + shift.entity[std::size_t(entity.dim)];
    if (!tags.empty()) ::gmsh::model::mesh::addElementsByType(owner, block.type, tags, nodes);
  }
}

/// The first file's name of a group wins.
void add_groups(const Guest& guest, const Shift& shift) {
  for (const PhysicalGroup& group : guest.groups) {
    std::vector<int> tags = group.entities;
    for (int& tag : tags) tag += shift.entity[std::size_t(group.dim)];
    add_to_group(group.dim, group.tag, tags, group.name);
  }
}

void add_guest(const ModelMesh& host, const Elements& host_elements, const Guest& guest, const Shift& shift) {
  add_entities(host, guest, shift);
  for (const EntityMesh& entity : guest.mesh.entities) add_nodes(host, entity, shift);
  for (const EntityMesh& entity : guest.mesh.entities) add_elements(host_elements, entity, shift);
  std::vector<PeriodicLink> links = guest.links;
  for (PeriodicLink& link : links) {
    link.slave += shift.entity[std::size_t(link.dim)];
    link.master += shift.entity[std::size_t(link.dim)];
    for (auto& [slave, master] : link.nodes) slave += shift.node, master += shift.node;
  }
  restore_links(links);
}

std::vector<ViewStep> shifted(std::vector<ViewStep> data, const Shift& shift) {
  for (ViewStep& step : data)
    for (std::size_t& tag : step.tags) tag += step.kind == "NodeData" ? shift.node : shift.element;
  return data;
}

/// A file may have data alone.
bool has_nodes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  for (std::string line; std::getline(in, line);)
    if (line.rfind("$Nodes", 0) == 0 || line.rfind("$NOD", 0) == 0) return true;
  return false;
}

constexpr const char* kMeshItFirst = "mesh the geometry to a .msh file first, and merge that";

bool is_discrete(int dim, int tag) { return entity_type(dim, tag).find("Discrete") != std::string::npos; }

/// An entity of a geometry, without nodes, and the box that it lies in.
struct Place {
  int dim = 0, tag = 0;
  Eigen::AlignedBox3d box;
};

std::vector<Place> read_empty_places() {
  std::vector<Place> places;
  ::gmsh::vectorpair entities;
  ::gmsh::model::getEntities(entities);
  for (const auto& [dim, tag] : entities) {
    if (dim == 3 || is_discrete(dim, tag) || has_elements(dim, tag)) continue;
    Eigen::Vector3d low, high;
    ::gmsh::model::getBoundingBox(dim, tag, low[0], low[1], low[2], high[0], high[1], high[2]);
    places.push_back({dim, tag, Eigen::AlignedBox3d(low, high)});
  }
  return places;
}

/// Gmsh puts what a mesh has on surface 1 on the surface 1 that is there, wherever that is.
void check_places(const std::string& path, const std::vector<Place>& places) {
  constexpr double kSlack = 1e-2;  // of the whole: a mesh of another size leaves a curved entity's box a little
  Eigen::AlignedBox3d whole;
  for (const Place& place : places) whole.extend(place.box);
  for (const Place& place : places) {
    std::vector<std::size_t> tags;
    std::vector<double> xyz, parameters;
    ::gmsh::model::mesh::getNodes(tags, xyz, parameters, place.dim, place.tag, false, false);
    for (std::size_t i = 0; i < tags.size(); ++i) {
      const Eigen::Vector3d p = Eigen::Vector3d::Map(&xyz[3 * i]);
      if (place.box.exteriorDistance(p) > kSlack * whole.diagonal().norm())
        throw InputError(fmt::format(
            "{} is not a mesh of the geometry that it is merged with: node {} at {} is not on the entity {} "
            "of dimension {}; {}",
            path, tags[i], describe(p), place.tag, place.dim, kMeshItFirst));
    }
  }
}

void merge_plainly(const std::string& path) {
  const std::vector<Place> places = read_empty_places();
  const StageLog log = run_logged([&] { ::gmsh::merge(path); });
  if (!log.errors.empty()) {
    const std::string errors = first_errors(log);
    const bool taken = errors.find("already exists") != std::string::npos;
    throw InputError(fmt::format("{} cannot be merged: {}{}", path, errors,
                                 taken ? fmt::format("; give its entities other numbers, or {}", kMeshItFirst) : ""));
  }
  check_places(path, places);
}

}  // namespace

std::vector<ViewStep> merge_file(const std::string& path) {
  check_readable(path);
  const MshHeader header = read_msh_header(path);
  if (header.version != 0) check_msh_file(path, header, false);
  ModelMesh host;
  if (header.version != 0) host = read_model_mesh();
  if (host.tags.empty() || !has_nodes(path)) return merge_plainly(path), std::vector<ViewStep>();

  const Guest guest = read_alone(path);
  const Elements host_elements = list_elements(host);
  const auto shift = find_shift(host, host_elements, guest);
  if (!shift) return merge_plainly(path), std::vector<ViewStep>();
  if (guest.partitioned)
    throw InputError(fmt::format("{} is partitioned, and its numbers are in use; merge first, then -part", path));
  const StageLog log = run_logged([&] { add_guest(host, host_elements, guest, *shift); });
  if (!log.errors.empty()) throw InputError(fmt::format("{} cannot be merged: {}", path, first_errors(log)));
  add_groups(guest, *shift);
  return shifted(guest.data, *shift);
}

void check_geometry_kept() {
  // With another geometry's number, what was there first stays.
  ::gmsh::vectorpair shapes;
  ::gmsh::model::occ::getEntities(shapes);
  for (const auto& [dim, tag] : shapes)
    if (is_discrete(dim, tag))
      throw InputError(fmt::format("the geometry's {} {} has the number of one that comes as a mesh; {}",
                                   dim == 2   ? "surface"
                                   : dim == 1 ? "curve"
                                   : dim == 0 ? "point"
                                              : "volume",
                                   tag, kMeshItFirst));
}

}  // namespace qmorph::adapter
