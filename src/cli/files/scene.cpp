// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/files/scene.hpp"

#include <map>
#include <span>
#include <utility>

#include "gmsh/model/model_mesh.hpp"
#include "gmsh/read/groups.hpp"

namespace qmorph::cli {
namespace {

using adapter::ElementBlock;
using adapter::EntityMesh;
using adapter::ModelMesh;
using report::Scene;
using report::SceneEntity;

class Builder {
 public:
  explicit Builder(const ModelMesh& mesh) : mesh_(mesh), row_(mesh.tags.size(), kNone) {}

  Scene run() {
    note_groups();
    for (const EntityMesh& entity : mesh_.entities) {
      if (entity.dim == 2) add_surface(entity);
      if (entity.dim == 1) add_curve(entity);
    }
    for (const EntityMesh& entity : mesh_.entities)
      if (entity.dim == 0) add_point(entity);
    return std::move(scene_);
  }

 private:
  void note_groups() {
    for (adapter::PhysicalGroup& group : adapter::read_physical_groups()) {
      for (int entity : group.entities) groups_[{group.dim, entity}].push_back(scene_.groups.size());
      scene_.groups.push_back({group.dim, group.tag, std::move(group.name)});
    }
  }

  /// Row of the scene; kNone for a node that does not exist.
  Index point(std::size_t tag) {
    const Index row = mesh_.rows.find(tag);
    if (row == kNone) return kNone;
    if (row_[row] == kNone) {
      row_[row] = Index(scene_.points.size());
      scene_.points.push_back(mesh_.points[row]);
      scene_.node_tags.push_back(tag);
    }
    return row_[row];
  }

  SceneEntity begin(const EntityMesh& entity, std::size_t first) const {
    SceneEntity result{entity.tag, {}, first, 0};
    if (const auto found = groups_.find({entity.dim, entity.tag}); found != groups_.end())
      result.groups = found->second;
    return result;
  }

  /// \pre `nodes` has room for the block's corners
  bool read_nodes(const ElementBlock& block, std::size_t element, std::span<Index> nodes) {
    for (std::size_t i = 0; i < block.corners; ++i) {
      nodes[i] = point(block.nodes[element * block.nodes_per_element + i]);
      if (nodes[i] == kNone) return false;
    }
    return true;
  }

  void add_surface(const EntityMesh& entity) {
    SceneEntity surface = begin(entity, scene_.faces.size());
    for (const ElementBlock& block : entity.blocks) {
      if (block.corners != 3 && block.corners != 4) continue;
      for (std::size_t e = 0; e < block.tags.size(); ++e) {
        std::array<Index, 4> nodes{kNone, kNone, kNone, kNone};
        if (!read_nodes(block, e, nodes)) continue;
        scene_.faces.push_back(nodes);
        scene_.face_tags.push_back(block.tags[e]);
      }
    }
    surface.count = scene_.faces.size() - surface.first;
    if (surface.count) scene_.surfaces.push_back(std::move(surface));
  }

  void add_curve(const EntityMesh& entity) {
    SceneEntity curve = begin(entity, scene_.lines.size());
    for (const ElementBlock& block : entity.blocks)
      for (std::size_t e = 0; e < block.tags.size(); ++e) {
        std::array<Index, 2> nodes{};
        if (block.corners == 2 && read_nodes(block, e, nodes)) scene_.lines.push_back(nodes);
      }
    curve.count = scene_.lines.size() - curve.first;
    if (curve.count) scene_.curves.push_back(std::move(curve));
  }

  /// Of a node that a surface or a curve has, too: centres of arcs are nothing to show. \pre surfaces and curves are in
  void add_point(const EntityMesh& entity) {
    for (const ElementBlock& block : entity.blocks)
      for (std::size_t tag : block.nodes)
        if (const Index row = mesh_.rows.find(tag); row != kNone && row_[row] != kNone)
          scene_.dots.push_back(row_[row]);
  }

  const ModelMesh& mesh_;
  std::vector<Index> row_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> groups_;  ///< of an entity
  Scene scene_;
};

}  // namespace

Scene read_scene() {
  const ModelMesh mesh = adapter::read_model_mesh();
  return Builder(mesh).run();
}

}  // namespace qmorph::cli
