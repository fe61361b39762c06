// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/model_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "geometry/describe.hpp"
#include "gmsh/session/compat.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

/// An array over tags is used if it has at most this many entries per node.
constexpr std::size_t kDenseFactor = 8;

std::size_t nodes_per_element(const ElementBlock& block) {
  return block.tags.empty() ? 0 : block.nodes.size() / block.tags.size();
}

void set_shape(ElementBlock& block) {
  // Asking Gmsh is slow, and nearly all blocks are of these types.
  if (block.type == kPoint1 || block.type == kLine2 || block.type == kTriangle3 || block.type == kQuad4) {
    block.corners = block.nodes_per_element;
    return;
  }
  const ElementType type = element_type(block.type);
  block.corners = type.corners;
  block.order = type.order;
}

EntityMesh read_entity(int dim, int tag) {
  EntityMesh entity;
  entity.dim = dim;
  entity.tag = tag;
  // Only surfaces are ever written back with parameters.
  const bool parametric = dim == 2;
  ::gmsh::model::mesh::getNodes(entity.node_tags, entity.xyz, entity.uv, dim, tag, false, parametric);
  // Nodes without parameters are left out of the array, which then fits nothing.
  if (entity.uv.size() != 2 * entity.node_tags.size()) entity.uv.clear();
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  ::gmsh::model::mesh::getElements(types, tags, nodes, dim, tag);
  for (std::size_t i = 0; i < types.size(); ++i) {
    ElementBlock block;
    block.type = types[i];
    block.tags = std::move(tags[i]);
    block.nodes = std::move(nodes[i]);
    block.nodes_per_element = nodes_per_element(block);
    set_shape(block);
    if (!block.tags.empty()) entity.blocks.push_back(std::move(block));
  }
  return entity;
}

void number_nodes(ModelMesh& mesh) {
  std::size_t count = 0;
  for (const EntityMesh& entity : mesh.entities) count += entity.node_tags.size();
  if (count >= kNone) throw InputError("the mesh has more nodes than 32 bits can count");
  mesh.tags.reserve(count);
  mesh.points.reserve(count);
  mesh.owner.reserve(count);
  for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
    const EntityMesh& entity = mesh.entities[e];
    for (std::size_t i = 0; i < entity.node_tags.size(); ++i) {
      mesh.tags.push_back(entity.node_tags[i]);
      mesh.points.emplace_back(entity.xyz[3 * i], entity.xyz[3 * i + 1], entity.xyz[3 * i + 2]);
      mesh.owner.push_back(e);
      mesh.max_node_tag = std::max(mesh.max_node_tag, entity.node_tags[i]);
    }
    for (const ElementBlock& block : entity.blocks)
      for (std::size_t tag : block.tags) mesh.max_element_tag = std::max(mesh.max_element_tag, tag);
  }
  mesh.rows = NodeRows(mesh.tags);
}

/// Lines and points are what stays: they must make sense. A surface's nodes are checked where it is read.
void check_low_elements(const ModelMesh& mesh) {
  for (const EntityMesh& entity : mesh.entities) {
    if (entity.dim > 1) break;
    for (const ElementBlock& block : entity.blocks)
      for (std::size_t i = 0; i < block.nodes.size(); ++i)
        if (mesh.rows.find(block.nodes[i]) == kNone)
          throw InputError(fmt::format("element {} of {} {} uses node {}, which the mesh does not have",
                                       block.tags[i / block.nodes_per_element], entity.dim == 0 ? "point" : "curve",
                                       entity.tag, block.nodes[i]));
  }
}

}  // namespace

std::size_t EntityMesh::element_count() const {
  std::size_t count = 0;
  for (const ElementBlock& block : blocks) count += block.tags.size();
  return count;
}

const ElementBlock* EntityMesh::block(int type) const {
  for (const ElementBlock& candidate : blocks)
    if (candidate.type == type) return &candidate;
  return nullptr;
}

const ElementBlock* EntityMesh::polygons(std::size_t corners) const {
  for (const ElementBlock& candidate : blocks)
    if (candidate.corners == corners) return &candidate;
  return nullptr;
}

const EntityMesh* find_entity(const ModelMesh& mesh, int dim, int tag) {
  const auto found = std::lower_bound(
      mesh.entities.begin(), mesh.entities.end(), std::pair(dim, tag),
      [](const EntityMesh& entity, const auto& wanted) { return std::pair(entity.dim, entity.tag) < wanted; });
  return found != mesh.entities.end() && found->dim == dim && found->tag == tag ? &*found : nullptr;
}

NodeRows::NodeRows(const std::vector<std::size_t>& tags) {
  std::size_t max_tag = 0;
  for (std::size_t tag : tags) max_tag = std::max(max_tag, tag);
  const bool dense = max_tag < kDenseFactor * (tags.size() + 1);
  if (dense)
    dense_.assign(max_tag + 1, kNone);
  else
    sparse_.reserve(tags.size());
  for (Index row = 0; row < tags.size(); ++row) {
    if (dense) {
      if (dense_[tags[row]] != kNone) duplicate_ = tags[row];
      dense_[tags[row]] = row;
    } else if (!sparse_.emplace(tags[row], row).second) {
      duplicate_ = tags[row];
    }
  }
}

ModelMesh read_model_mesh() {
  ModelMesh mesh;
  ::gmsh::vectorpair entities;
  ::gmsh::model::getEntities(entities);
  std::sort(entities.begin(), entities.end());
  for (const auto& [dim, tag] : entities) mesh.entities.push_back(read_entity(dim, tag));
  number_nodes(mesh);
  if (mesh.rows.duplicate())
    throw InputError(fmt::format("two nodes have the tag {}; renumber the nodes", mesh.rows.duplicate()));
  check_low_elements(mesh);
  return mesh;
}

NodeUse find_node_use(const ModelMesh& mesh, const std::vector<std::size_t>& pinned_tags) {
  const std::size_t count = mesh.tags.size();
  NodeUse use;
  use.surface.assign(count, kNobody);
  use.volume.assign(count, kNobody);
  for (auto* flags : {&use.several, &use.point, &use.line, &use.pinned}) flags->assign(count, false);
  for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
    const EntityMesh& entity = mesh.entities[e];
    for (const ElementBlock& block : entity.blocks)
      for (std::size_t tag : block.nodes) {
        const Index row = mesh.rows.find(tag);
        if (row == kNone) continue;
        if (entity.dim == 0) use.point[row] = true;
        if (entity.dim == 1) use.line[row] = true;
        if (entity.dim == 3 && use.volume[row] == kNobody) use.volume[row] = e;
        if (entity.dim != 2) continue;
        if (use.surface[row] == kNobody) use.surface[row] = e;
        if (use.surface[row] != e) use.several[row] = true;
      }
  }
  for (Index row = 0; row < count; ++row)
    use.pinned[row] = use.point[row] || use.line[row] || mesh.entities[mesh.owner[row]].dim < 2;
  for (std::size_t tag : pinned_tags)
    if (const Index row = mesh.rows.find(tag); row != kNone) use.pinned[row] = true;
  return use;
}

bool is_misclassified(const ModelMesh& mesh, const NodeUse& use) {
  for (Index row = 0; row < mesh.tags.size(); ++row) {
    const std::uint32_t owner = mesh.owner[row];
    if (mesh.entities[owner].dim < 2) continue;
    if (use.point[row] || use.line[row]) return true;
    // A node of a volume or of another surface, which only this one surface uses.
    if (use.surface[row] != kNobody && use.surface[row] != owner && !use.several[row] && use.volume[row] == kNobody)
      return true;
  }
  return false;
}

std::string describe_node(const ModelMesh& mesh, Index row) {
  return fmt::format("node {} at {}", mesh.tags[row], describe(mesh.points[row]));
}

ErrorDetails at_node(const ModelMesh& mesh, Index row, ErrorKind kind) {
  return {.kind = kind, .place = mesh.points[row], .subject = ErrorSubject{ErrorSubject::Kind::node, mesh.tags[row]}};
}

}  // namespace qmorph::adapter
