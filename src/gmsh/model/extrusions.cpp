// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/extrusions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "gmsh/session/compat.hpp"

namespace qmorph::adapter {
namespace {

/// How far nodes may be from where the motion takes them, in the size of the surface: Gmsh's own, which it finds the
/// nodes again with, is 1e-8 of the model's.
constexpr double kMotionTolerance = 1e-7;

using NodePairs = std::map<std::size_t, std::size_t>;  // tags: of the first surface, of the second

/// Which nodes correspond if the triangles do, one by one; `turned`: those of the second run the other way around.
std::optional<NodePairs> pair_nodes(const ElementBlock& first, const ElementBlock& second, bool turned) {
  NodePairs pairs;
  const std::array<std::size_t, 3> corner =
      turned ? std::array<std::size_t, 3>{0, 2, 1} : std::array<std::size_t, 3>{0, 1, 2};
  for (std::size_t i = 0; i < first.nodes.size(); i += first.nodes_per_element)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t other = second.nodes[i + corner[k]];
      if (pairs.try_emplace(first.nodes[i + k], other).first->second != other) return std::nullopt;
    }
  std::set<std::size_t> images;
  for (const auto& [node, other] : pairs) images.insert(other);
  if (images.size() != pairs.size()) return std::nullopt;
  return pairs;
}

/// The rigid motion that takes the nodes of the first surface to those of the second, by rows, if there is one.
std::optional<std::vector<double>> motion_of(const ModelMesh& mesh, const NodePairs& pairs) {
  Eigen::Matrix3Xd from(3, pairs.size()), to(3, pairs.size());
  Eigen::Index at = 0;
  for (const auto& [node, other] : pairs) {
    from.col(at) = mesh.points[mesh.rows.find(node)];
    to.col(at++) = mesh.points[mesh.rows.find(other)];
  }
  const Eigen::Matrix4d motion = Eigen::umeyama(from, to, false);
  const Eigen::AlignedBox3d box(from.rowwise().minCoeff(), from.rowwise().maxCoeff());
  const double off = ((motion.topLeftCorner<3, 3>() * from).colwise() + motion.topRightCorner<3, 1>() - to)
                         .colwise()
                         .norm()
                         .maxCoeff();
  if (!(off <= kMotionTolerance * box.diagonal().norm())) return std::nullopt;
  std::vector<double> rows;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) rows.push_back(motion(i, k));
  return rows;
}

bool is_made_of(const EntityMesh& surface, std::size_t corners) {
  const ElementBlock* block = surface.polygons(corners);
  return block && !block->tags.empty() && surface.element_count() == block->tags.size();
}

bool has_all_nodes(const ModelMesh& mesh, const ElementBlock& block) {
  return std::all_of(block.nodes.begin(), block.nodes.end(),
                     [&](std::size_t node) { return mesh.rows.find(node) != kNone; });
}

std::optional<PeriodicLink> link_between(const ModelMesh& mesh, const EntityMesh& first, const EntityMesh& second) {
  const ElementBlock &from = *first.polygons(3), &to = *second.polygons(3);
  if (from.type != to.type || from.tags.size() != to.tags.size()) return std::nullopt;
  for (const bool turned : {false, true}) {
    const std::optional<NodePairs> pairs = pair_nodes(from, to, turned);
    if (!pairs) continue;
    const std::optional<std::vector<double>> motion = motion_of(mesh, *pairs);
    if (!motion) continue;
    PeriodicLink link;
    link.slave = second.tag;
    link.master = first.tag;
    link.transformation = *motion;
    link.is_extrusion = true;
    for (const auto& [node, other] : *pairs) link.nodes.emplace_back(other, node);
    std::sort(link.nodes.begin(), link.nodes.end());
    return link;
  }
  return std::nullopt;
}

/// Pairs of surfaces that may be the ends of a volume: of its surfaces they alone have triangles.
std::vector<std::pair<int, int>> find_ends(const ModelMesh& mesh, const std::set<int>& wanted,
                                           const std::set<int>& walls) {
  std::vector<std::pair<int, int>> pairs;
  for (const EntityMesh& volume : mesh.entities) {
    if (volume.dim != 3 || volume.element_count() > 0) continue;
    ::gmsh::vectorpair skin;
    ::gmsh::model::getBoundary({{3, volume.tag}}, skin, false, false);
    std::vector<int> ends;
    for (const auto& [dim, tag] : skin)
      if (!walls.count(tag)) ends.push_back(tag);
    if (ends.size() == 2 && skin.size() > 2 && wanted.count(ends[0]) && wanted.count(ends[1]))
      pairs.emplace_back(std::min(ends[0], ends[1]), std::max(ends[0], ends[1]));
  }
  return pairs;
}

}  // namespace

std::vector<PeriodicLink> find_extrusions(const ModelMesh& mesh, const std::vector<std::uint32_t>& entities,
                                          const std::vector<PeriodicLink>& known) {
  std::map<int, const EntityMesh*> surface;  // by tag
  std::set<int> walls, wanted;
  for (const EntityMesh& entity : mesh.entities)
    if (entity.dim == 2 && is_made_of(entity, 4)) walls.insert(entity.tag);
  for (std::uint32_t e : entities)
    if (is_made_of(mesh.entities[e], 3) && has_all_nodes(mesh, *mesh.entities[e].polygons(3)))
      surface[mesh.entities[e].tag] = &mesh.entities[e], wanted.insert(mesh.entities[e].tag);
  for (const PeriodicLink& link : known) wanted.erase(link.slave), wanted.erase(link.master);

  // In a pile of volumes the one end of each is the other end of the next: from the lowest tag on, each has one master.
  const std::vector<std::pair<int, int>> pairs = find_ends(mesh, wanted, walls);
  std::vector<PeriodicLink> links;
  std::set<int> done;
  for (int root : wanted) {
    std::vector<int> reached;
    if (done.insert(root).second) reached.push_back(root);
    for (std::size_t i = 0; i < reached.size(); ++i)
      for (const auto& [a, b] : pairs) {
        if (a != reached[i] && b != reached[i]) continue;
        const int slave = a == reached[i] ? b : a;
        if (done.count(slave)) continue;
        std::optional<PeriodicLink> link = link_between(mesh, *surface[reached[i]], *surface[slave]);
        if (!link) continue;
        links.push_back(std::move(*link));
        done.insert(slave);
        reached.push_back(slave);
      }
  }
  return links;
}

std::set<int> find_extruded_walls(const ModelMesh& mesh, const std::vector<PeriodicLink>& extrusions) {
  std::set<int> walls;
  for (const EntityMesh& volume : mesh.entities) {
    if (volume.dim != 3) continue;
    ::gmsh::vectorpair skin;
    ::gmsh::model::getBoundary({{3, volume.tag}}, skin, false, false);
    std::set<int> surfaces;
    for (const auto& [dim, tag] : skin) surfaces.insert(tag);
    const bool is_extruded = std::any_of(extrusions.begin(), extrusions.end(), [&](const PeriodicLink& link) {
      return surfaces.count(link.slave) && surfaces.count(link.master);
    });
    for (const int tag : is_extruded ? surfaces : std::set<int>())
      if (is_made_of(*find_entity(mesh, 2, tag), 4)) walls.insert(tag);
  }
  return walls;
}

}  // namespace qmorph::adapter
