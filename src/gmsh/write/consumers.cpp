// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/write/consumers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <unordered_set>
#include <utility>

#include "geometry/describe.hpp"
#include "gmsh/model/model_mesh.hpp"
#include "gmsh/read/groups.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

constexpr std::array kConsumers = {
    // grid_in.cc: throws for a boundary id on an inner face; reorders quads only if there are no other elements.
    Consumer{.name = "dealii",
             .title = "deal.II",
             .format = "msh2",
             .only_quads = true,
             .inner_lines = false,
             .oriented = true},
    // gmsh.cpp: all attributes positive; one order in a file.
    Consumer{.name = "mfem", .title = "MFEM", .format = "msh2", .max_order = 10, .oriented = true, .periodic = true},
    // gmsh.py: every cell tagged exactly once; no 8-node quads; node numbers without gaps.
    Consumer{.name = "dolfinx",
             .title = "DOLFINx",
             .format = "msh2",
             .max_order = 2,
             .only_quads = true,
             .needs_surface_groups = true},
    // egconvert.c: 404, 408, 409.
    Consumer{.name = "elmer", .title = "ElmerGrid", .format = "msh2", .max_order = 2},
    Consumer{.name = "su2",
             .title = "SU2",
             .format = "su2",
             .inner_lines = false,
             .needs_curve_groups = true,
             .planar = true,
             .oriented = true},
    Consumer{.name = "calculix",
             .title = "CalculiX",
             .format = "inp",
             .max_order = 2,
             .wants_incomplete = true,
             .oriented = true},
    Consumer{.name = "abaqus",
             .title = "Abaqus",
             .format = "inp",
             .max_order = 2,
             .wants_incomplete = true,
             .oriented = true},
    // gmshToFoam.C: version 2 in ASCII; quads are patches of the cells behind them.
    Consumer{.name = "openfoam", .title = "gmshToFoam", .format = "msh2", .needs_volumes = true},
    // LibGmsh2Specfem: the first element must be a line, and its type says whether quads have 4 or 9 nodes; a name that
    // is missing ends the program.
    Consumer{.name = "specfem2d",
             .title = "SPECFEM2D",
             .format = "msh2",
             .max_order = 2,
             .only_quads = true,
             .points = false,
             .specfem_names = true,
             .needs_surface_groups = true,
             .planar = true,
             .oriented = true},
};

using Edge = std::pair<std::size_t, std::size_t>;

/// How many surface elements there are at each edge.
std::map<Edge, int> count_sides(const ModelMesh& mesh) {
  std::map<Edge, int> count;
  for (const EntityMesh& entity : mesh.entities) {
    if (entity.dim != 2) continue;
    for (const ElementBlock& block : entity.blocks)
      for (std::size_t i = 0; i < block.nodes.size(); i += block.nodes_per_element)
        for (std::size_t k = 0; k < block.corners; ++k)
          ++count[std::minmax(block.nodes[i + k], block.nodes[i + (k + 1) % block.corners])];
  }
  return count;
}

class ConsumerMeshBuilder {
 public:
  ConsumerMeshBuilder(const Consumer& consumer, bool everything)
      : consumer_(consumer), mesh_(read_model_mesh()), everything_(everything) {
    ::gmsh::vectorpair groups;
    ::gmsh::model::getPhysicalGroups(groups);
    if (groups.empty()) everything_ = true;
    if (!consumer.inner_lines) sides_ = count_sides(mesh_);
    for (const EntityMesh& entity : mesh_.entities)
      for (const ElementBlock& block : entity.blocks)
        if (entity.dim > 0) joined_.insert(block.nodes.begin(), block.nodes.end());
  }

  ConsumerMesh build();

 private:
  void add_entity(const EntityMesh& entity);
  void complain_of_groups(const EntityMesh& entity, const std::vector<int>& groups);
  void add_links();
  /// Counts of what readers are particular about.
  struct Census {
    std::size_t triangles = 0, volumes = 0, grouped_lines = 0;
    std::size_t curved_quads_with_middle = 0, curved_quads_without_middle = 0;
    std::set<int> orders;
  };
  Census count_elements() const;
  void complain_of_elements();
  void complain_of_middle_nodes(const Census& census);
  void complain_of_names();
  void complain_of_height();
  bool is_inner_line(const ElementBlock& block, std::size_t i) const;
  std::size_t number(std::size_t tag);
  Eigen::Vector3d point(std::size_t tag) const { return mesh_.points[mesh_.rows.find(tag)]; }

  const Consumer& consumer_;
  ModelMesh mesh_;
  bool everything_;
  double scale_ = get_option("Mesh.ScalingFactor");
  std::map<Edge, int> sides_;
  std::unordered_set<std::size_t> joined_;  ///< nodes of elements other than points
  std::map<std::size_t, std::size_t> numbers_;
  ConsumerMesh result_;
  std::set<int> signs_;  // of the surfaces' groups: 1 in one, 0 in none
};

std::size_t ConsumerMeshBuilder::number(std::size_t tag) {
  const auto [found, is_new] = numbers_.try_emplace(tag, numbers_.size() + 1);
  if (is_new) result_.nodes.push_back(scale_ * point(tag));
  return found->second;
}

bool ConsumerMeshBuilder::is_inner_line(const ElementBlock& block, std::size_t i) const {
  const auto side = sides_.find(std::minmax(block.nodes[i], block.nodes[i + 1]));
  return side == sides_.end() || side->second != 1;
}

void ConsumerMeshBuilder::complain_of_groups(const EntityMesh& entity, const std::vector<int>& groups) {
  if (groups.size() > 1 && entity.dim >= 1)
    result_.complaints.push_back(fmt::format("{} {} is in {} physical groups, and {} takes one per element",
                                             entity.dim == 1 ? "curve" : "surface", entity.tag, groups.size(),
                                             consumer_.title));
  if (entity.dim != 2) return;
  signs_.insert(groups.empty() ? 0 : 1);
  if (groups.empty() && consumer_.needs_surface_groups)
    result_.complaints.push_back(fmt::format("surface {} is in no physical group, and {} needs a tag for every cell",
                                             entity.tag, consumer_.title));
}

void ConsumerMeshBuilder::add_entity(const EntityMesh& entity) {
  std::vector<int> groups;
  ::gmsh::model::getPhysicalGroupsForEntity(entity.dim, entity.tag, groups);
  if (entity.blocks.empty() || (groups.empty() && !everything_)) return;
  if (entity.dim == 0 && !consumer_.points) return;
  complain_of_groups(entity, groups);
  for (const ElementBlock& block : entity.blocks)
    for (std::size_t i = 0; i < block.nodes.size(); i += block.nodes_per_element) {
      if (entity.dim == 1 && !consumer_.inner_lines && is_inner_line(block, i)) continue;
      // A node without elements is a row of zeros in a matrix. In decks one may be intended, to tie others to.
      const bool may_be_loose = consumer_.format == "inp" && !groups.empty();
      if (entity.dim == 0 && !may_be_loose && !joined_.count(block.nodes[i])) continue;
      ConsumerElement element{entity.dim, block.type, entity.tag, groups, {}};
      const auto begin = block.nodes.begin() + static_cast<std::ptrdiff_t>(i);
      element.nodes.assign(begin, begin + static_cast<std::ptrdiff_t>(block.nodes_per_element));
      for (std::size_t& node : element.nodes) node = number(node);
      result_.elements.push_back(std::move(element));
    }
}

/// The converter of SPECFEM2D looks for these.
void ConsumerMeshBuilder::complain_of_names() {
  std::set<std::string> missing = {"Bottom", "Left", "Right", "Top"};
  std::string wrong;
  for (const PhysicalGroup& group : read_physical_groups()) {
    if (group.dim == 1) missing.erase(group.name);
    const bool is_medium =
        group.name.size() > 1 && group.name[0] == 'M' &&
        std::all_of(group.name.begin() + 1, group.name.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (group.dim == 2 && !is_medium)
      wrong += fmt::format("{}{} \"{}\"", wrong.empty() ? "" : ", ", group.tag, group.name);
  }
  if (!missing.empty())
    result_.complaints.push_back(fmt::format("{} needs physical curves Top, Bottom, Left and Right, and there is no {}",
                                             consumer_.title, fmt::join(missing, ", ")));
  if (!wrong.empty())
    result_.complaints.push_back(
        fmt::format("{} needs physical surfaces to be named M1, M2, ..., and there is {}", consumer_.title, wrong));
}

/// How many elements of each kind the reader would get.
ConsumerMeshBuilder::Census ConsumerMeshBuilder::count_elements() const {
  Census census;
  std::map<int, ElementType> types;
  for (const ConsumerElement& element : result_.elements) {
    if (!types.count(element.type)) types[element.type] = element_type(element.type);
    const ElementType& type = types.at(element.type);
    const bool is_quad = element.dim == 2 && type.corners == 4;
    census.triangles += element.dim == 2 && type.corners == 3;
    census.volumes += element.dim == 3;
    census.grouped_lines += element.dim == 1 && !element.groups.empty();
    census.curved_quads_without_middle += is_quad && type.order > 1 && type.incomplete();
    census.curved_quads_with_middle += is_quad && type.order > 1 && !type.incomplete();
    if (element.dim > 0) census.orders.insert(type.order);
  }
  return census;
}

void ConsumerMeshBuilder::complain_of_elements() {
  const Census census = count_elements();
  const auto say = [&](const std::string& what) { result_.complaints.push_back(what); };
  if (census.triangles && consumer_.only_quads)
    say(fmt::format(
        "{} triangle{} left, and {} takes quads only; --all-quad, or an even number of sides around each surface, "
        "leaves none",
        census.triangles, census.triangles == 1 ? " is" : "s are", consumer_.title));
  if (!census.volumes && consumer_.needs_volumes)
    say(fmt::format(
        "there are no cells of dimension 3, and {} reads no others; extrude the quads by one layer, or use -3",
        consumer_.title));
  if (!census.grouped_lines && consumer_.needs_curve_groups)
    say(fmt::format("no curve is in a physical group, so {} would have no marker", consumer_.title));
  if (const int order = census.orders.empty() ? 1 : *census.orders.rbegin(); order > consumer_.max_order)
    say(fmt::format("the elements are of order {}, and {} takes order {} at most", order, consumer_.title,
                    consumer_.max_order));
  if (census.orders.size() > 1)
    say(fmt::format("the elements are of orders {}, and {} takes only one order in a file",
                    fmt::join(census.orders, " and "), consumer_.title));
  if (consumer_.specfem_names) complain_of_names();
  complain_of_middle_nodes(census);
  if (consumer_.name == "mfem" && signs_.size() > 1)
    say("some surfaces are in a physical group and some are not, which makes a non-positive element attribute for "
        "MFEM");
}

/// Quads of order 2 have 8 nodes, or 9 with the one in the middle.
void ConsumerMeshBuilder::complain_of_middle_nodes(const Census& census) {
  if (consumer_.max_order < 2 || consumer_.name == "elmer") return;  // it takes both
  if (!(consumer_.wants_incomplete ? census.curved_quads_with_middle : census.curved_quads_without_middle)) return;
  result_.complaints.push_back(fmt::format("{} needs quads with {} nodes (-setnumber Mesh.SecondOrderIncomplete {})",
                                           consumer_.title, consumer_.wants_incomplete ? "8" : "9",
                                           consumer_.wants_incomplete ? 1 : 0));
}

void ConsumerMeshBuilder::complain_of_height() {
  const double z = result_.nodes.empty() ? 0 : result_.nodes.front().z();
  if (const std::optional<Eigen::Vector3d> off = find_off_plane(result_, z))
    result_.complaints.push_back(
        fmt::format("{} takes surfaces only in a plane z = constant, and this mesh has nodes at {} and at {}",
                    consumer_.title, describe(result_.nodes.front()), describe(*off)));
}

/// Links between nodes that the reader gets.
void ConsumerMeshBuilder::add_links() {
  for (const int dim : {0, 1, 2})
    for (PeriodicLink& link : read_periodic_links(mesh_, dim)) {
      std::vector<std::pair<std::size_t, std::size_t>> pairs;
      for (const auto& [slave, master] : link.nodes) {
        const auto one = numbers_.find(slave), other = numbers_.find(master);
        if (one != numbers_.end() && other != numbers_.end()) pairs.emplace_back(one->second, other->second);
      }
      link.nodes = std::move(pairs);
      if (!link.nodes.empty()) result_.links.push_back(std::move(link));
    }
}

ConsumerMesh ConsumerMeshBuilder::build() {
  for (const EntityMesh& entity : mesh_.entities) add_entity(entity);
  if (consumer_.periodic) add_links();
  complain_of_elements();
  if (consumer_.planar && dimension(result_) == 2) complain_of_height();
  return std::move(result_);
}

}  // namespace

int dimension(const ConsumerMesh& mesh) {
  int dim = 0;
  for (const ConsumerElement& element : mesh.elements) dim = std::max(dim, element.dim);
  return dim;
}

std::optional<Eigen::Vector3d> find_off_plane(const ConsumerMesh& mesh, double z) {
  constexpr double kInPlane = 1e-9;  // of the mesh's extent
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.nodes) box.extend(p);
  const auto off = std::find_if(mesh.nodes.begin(), mesh.nodes.end(), [&](const Eigen::Vector3d& p) {
    return std::abs(p.z() - z) > kInPlane * box.diagonal().norm();
  });
  return off == mesh.nodes.end() ? std::nullopt : std::optional(*off);
}

const Consumer& find_consumer(const std::string& name) {
  std::string names;
  for (const Consumer& consumer : kConsumers) {
    if (consumer.name == name) return consumer;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", consumer.name);
  }
  throw UsageError(fmt::format("--for: there is no reader '{}' ({})", name, names));
}

ConsumerMesh collect_for(const Consumer& consumer, bool everything) {
  return ConsumerMeshBuilder(consumer, everything).build();
}

}  // namespace qmorph::adapter
