// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/convert/replace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <utility>

#include "gmsh/model/high_order.hpp"
#include "gmsh/model/put_back.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

/// Gmsh looks nodes and elements up by an int: larger tags would be taken for others, or for none.
constexpr std::size_t kMaxTag = std::numeric_limits<int>::max();

/// Tags of what goes, in order; then tags above all others; where there is no more room, those that nothing has.
class TagPool {
 public:
  /// \param used gives all tags that must not be given again; asked only when there is no room above `max`
  TagPool(std::vector<std::size_t> free, std::size_t max, std::function<std::vector<std::size_t>()> used)
      : free_(std::move(free)), max_(max), used_(std::move(used)) {
    std::sort(free_.begin(), free_.end(), std::greater<>());
  }
  std::size_t next() {
    if (!free_.empty()) {
      const std::size_t tag = free_.back();
      free_.pop_back();
      return tag;
    }
    if (max_ < kMaxTag) return ++max_;
    return next_gap();
  }

 private:
  std::size_t next_gap() {
    if (gap_ == 0) {
      taken_ = used_();
      std::sort(taken_.begin(), taken_.end());
    }
    ++gap_;
    while (at_ < taken_.size() && taken_[at_] <= gap_) gap_ += taken_[at_++] == gap_;
    // Above the input's largest tag are those that this pool has given out.
    if (gap_ >= (taken_.empty() ? kMaxTag : taken_.back()))
      throw InputError(
          fmt::format("numbers of nodes or elements up to {} leave no room for new ones; renumber the mesh", max_));
    return gap_;
  }

  std::vector<std::size_t> free_;
  std::size_t max_;
  std::function<std::vector<std::size_t>()> used_;
  std::vector<std::size_t> taken_;
  std::size_t gap_ = 0, at_ = 0;
};

std::vector<std::size_t> all_element_tags(const ModelMesh& mesh) {
  std::vector<std::size_t> tags;
  for (const EntityMesh& entity : mesh.entities)
    for (const ElementBlock& block : entity.blocks) tags.insert(tags.end(), block.tags.begin(), block.tags.end());
  return tags;
}

std::vector<std::size_t> tags_of_removed(const ModelMesh& mesh, const std::vector<ConvertedSurface>& surfaces) {
  std::vector<std::size_t> tags;
  for (const ConvertedSurface& converted : surfaces)
    for (std::size_t corners : {3, 4}) {
      if (corners == 4 && !converted.surface.quads_may_go) continue;
      if (const ElementBlock* block = mesh.entities[converted.surface.entity].polygons(corners))
        tags.insert(tags.end(), block->tags.begin(), block->tags.end());
    }
  return tags;
}

/// Parameters of a node of the result, or NaN.
Eigen::Vector2d parameters_of(const ModelMesh& mesh, const ConvertedSurface& converted, std::size_t part, Index node) {
  if (converted.parameters.empty()) return kNoParameters;
  const Eigen::Vector2d& found = converted.parameters[part][node];
  const EntityMesh& before = mesh.entities[converted.surface.entity];
  const Index source = converted.results[part].source[node];
  if (!std::isnan(found.x()) || source == kNone || before.uv.empty()) return found;
  const Index row = converted.surface.parts[part].rows[source] - mesh.rows.find(before.node_tags.front());
  return {before.uv[2 * row], before.uv[2 * row + 1]};
}

/// Tags of the nodes of one part's result. Those that the surface owns, and new ones, go into `entity`.
std::vector<std::size_t> place_nodes(const ModelMesh& mesh, const ConvertedSurface& converted, std::size_t p,
                                     TagPool& node_tags, std::set<Index>& placed, EntityMesh& entity) {
  const SurfacePart& part = converted.surface.parts[p];
  const QuadMesh& result = converted.results[p];
  std::vector<std::size_t> tags(result.points.size());
  for (Index i = 0; i < result.points.size(); ++i) {
    const Index row = result.source[i] == kNone ? kNone : part.rows[result.source[i]];
    tags[i] = row == kNone ? node_tags.next() : mesh.tags[row];
    if (row != kNone && mesh.owner[row] != converted.surface.entity) continue;
    // Parts of one surface may touch at a node that the surface owns.
    if (converted.results.size() > 1 && row != kNone && !placed.insert(row).second) continue;
    entity.node_tags.push_back(tags[i]);
    entity.xyz.insert(entity.xyz.end(), result.points[i].data(), result.points[i].data() + 3);
    const Eigen::Vector2d parameters = parameters_of(mesh, converted, p, i);
    entity.uv.insert(entity.uv.end(), parameters.data(), parameters.data() + 2);
  }
  return tags;
}

ElementBlock new_block(int type, std::size_t nodes_per_element) {
  ElementBlock block;
  block.type = type;
  block.nodes_per_element = block.corners = nodes_per_element;
  return block;
}

/// Parameters for CAD surfaces: projection, raising the order and 3D meshing use them.
void parametrise(EntityMesh& entity) {
  std::vector<double> uv;
  const StageLog log = run_logged([&] { ::gmsh::model::getParametrization(2, entity.tag, entity.xyz, uv); });
  if (!log.errors.empty() || uv.size() != 2 * entity.node_tags.size()) uv.clear();
  entity.uv = std::move(uv);
}

EntityMesh make_entity(const ModelMesh& mesh, const ConvertedSurface& converted, TagPool& node_tags,
                       TagPool& element_tags, PartTags& part_tags) {
  const EntityMesh& before = mesh.entities[converted.surface.entity];
  EntityMesh entity;
  entity.dim = 2;
  entity.tag = before.tag;
  ElementBlock triangles = new_block(kTriangle3, 3), quads = new_block(kQuad4, 4);
  std::set<Index> placed;
  for (std::size_t p = 0; p < converted.results.size(); ++p) {
    const SurfacePart& part = converted.surface.parts[p];
    const QuadMesh& result = converted.results[p];
    const auto tags = place_nodes(mesh, converted, p, node_tags, placed, entity);
    part_tags.push_back(tags);
    for (const auto& triangle : result.triangles)
      for (Index i : triangle) triangles.nodes.push_back(tags[i]);
    for (std::size_t q = 0; q < result.quads.size(); ++q) {
      quads.tags.push_back(q < part.quad_tags.size() ? part.quad_tags[q] : 0);  // 0: still to be given
      for (Index i : result.quads[q]) quads.nodes.push_back(tags[i]);
    }
  }
  triangles.tags.assign(triangles.nodes.size() / 3, 0);
  for (ElementBlock* block : {&triangles, &quads}) {
    for (std::size_t& tag : block->tags)
      if (tag == 0) tag = element_tags.next();
    if (!block->tags.empty()) entity.blocks.push_back(std::move(*block));
  }
  if (!converted.curved.empty())
    raise_order(mesh, before, converted.curved, part_tags, entity, [&] { return node_tags.next(); });
  if (std::any_of(entity.uv.begin(), entity.uv.end(), [](double u) { return std::isnan(u); })) entity.uv.clear();
  if (!before.uv.empty() && entity.uv.size() != 2 * entity.node_tags.size()) parametrise(entity);
  return entity;
}

}  // namespace

std::vector<PartTags> replace_surfaces(const ModelMesh& mesh, const std::vector<ConvertedSurface>& surfaces) {
  if (surfaces.empty()) return {};
  TagPool node_tags({}, mesh.max_node_tag, [&] { return mesh.tags; });
  TagPool element_tags(tags_of_removed(mesh, surfaces), mesh.max_element_tag, [&] { return all_element_tags(mesh); });
  std::vector<EntityMesh> entities;
  std::vector<PartTags> part_tags(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    entities.push_back(make_entity(mesh, surfaces[i], node_tags, element_tags, part_tags[i]));
  std::vector<Replacement> replacements;
  for (std::size_t i = 0; i < surfaces.size(); ++i) replacements.push_back({surfaces[i].surface.entity, &entities[i]});
  put_back(mesh, replacements);
  return part_tags;
}

}  // namespace qmorph::adapter
