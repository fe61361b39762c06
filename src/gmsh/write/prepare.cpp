// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/write/prepare.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "gmsh/model/model_mesh.hpp"
#include "gmsh/model/orientation.hpp"
#include "gmsh/model/periodic_links.hpp"
#include "gmsh/model/put_back.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"
#include "quality/sides.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector3d;

/// Where an element of a surface is stored.
struct Place {
  std::uint32_t entity = 0;
  std::size_t block = 0, first = 0;  ///< `first` of its nodes
};

/// The surface elements of a model, by their corners alone.
struct SurfaceElements {
  std::vector<std::array<Index, 3>> triangles;
  std::vector<std::array<Index, 4>> quads;
  std::vector<Place> places;  ///< triangles first
};

SurfaceElements collect(const ModelMesh& mesh) {
  SurfaceElements all;
  for (const std::size_t corners : {3, 4})
    for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
      const EntityMesh& entity = mesh.entities[e];
      for (std::size_t b = 0; entity.dim == 2 && b < entity.blocks.size(); ++b) {
        const ElementBlock& block = entity.blocks[b];
        for (std::size_t i = 0; block.corners == corners && i < block.nodes.size(); i += block.nodes_per_element) {
          std::array<Index, 4> rows{};
          for (std::size_t k = 0; k < corners; ++k) rows[k] = mesh.rows.find(block.nodes[i + k]);
          if (std::count(rows.begin(), rows.begin() + corners, kNone)) continue;
          if (corners == 3)
            all.triangles.push_back({rows[0], rows[1], rows[2]});
          else
            all.quads.push_back(rows);
          all.places.push_back({e, b, i});
        }
      }
    }
  return all;
}

Vector3d area_vector(const ModelMesh& mesh, const SurfaceElements& all, std::size_t element) {
  const auto area = [&](const auto& rows) {
    Vector3d sum = Vector3d::Zero();
    const Vector3d& origin = mesh.points[rows[0]];
    for (std::size_t k = 2; k < rows.size(); ++k)
      sum += (mesh.points[rows[k - 1]] - origin).cross(mesh.points[rows[k]] - origin);
    return sum;
  };
  return element < all.triangles.size() ? area(all.triangles[element])
                                        : area(all.quads[element - all.triangles.size()]);
}

/// Turns over whole parts that are flat and show their back.
void show_fronts(const ModelMesh& mesh, const SurfaceElements& all, Orientation& orientation) {
  constexpr double kFlat = 1e-6;
  std::vector<Vector3d> sums(orientation.parts, Vector3d::Zero());
  std::vector<double> areas(orientation.parts, 0);
  for (std::size_t e = 0; e < all.places.size(); ++e) {
    const Vector3d area = area_vector(mesh, all, e);
    sums[orientation.part[e]] += orientation.flip[e] ? Vector3d(-area) : area;
    areas[orientation.part[e]] += area.norm();
  }
  std::vector<bool> turned(orientation.parts);
  for (Index p = 0; p < orientation.parts; ++p) {
    Eigen::Index most = 0;
    sums[p].cwiseAbs().maxCoeff(&most);
    turned[p] = sums[p].norm() > (1 - kFlat) * areas[p] && sums[p][most] < 0;
  }
  for (std::size_t e = 0; e < all.places.size(); ++e)
    if (turned[orientation.part[e]]) orientation.flip[e] = !orientation.flip[e];
}

/// Reverses the nodes of an element, which keeps its first corner. Orders 1 and 2.
void turn(ElementBlock& block, std::size_t first) {
  const auto at = [&](std::size_t i) { return block.nodes.begin() + static_cast<std::ptrdiff_t>(first + i); };
  std::reverse(at(1), at(block.corners));
  if (block.order == 2) std::reverse(at(block.corners), at(2 * block.corners));
}

/// Puts the changed entities in the place of the model's. Periodic links stay valid, since node numbers do not change.
void exchange(const ModelMesh& mesh, const std::vector<EntityMesh>& entities, const std::set<std::uint32_t>& changed) {
  const std::vector<PeriodicLink> links = read_periodic_links(mesh);
  std::vector<Replacement> replacements;
  for (const std::uint32_t e : changed) replacements.push_back({e, &entities[e]});
  put_back(mesh, replacements);
  if (!links.empty()) restore_links(links);
}

bool has_volume_elements(const ModelMesh& mesh) {
  return std::any_of(mesh.entities.begin(), mesh.entities.end(),
                     [](const EntityMesh& entity) { return entity.dim == 3 && entity.element_count() > 0; });
}

/// Counts the edges whose two elements still run along them in the same direction.
std::size_t count_conflicts(const std::vector<Side>& sides, const Orientation& orientation) {
  std::size_t conflicts = 0;
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() != 2) return;
    const bool agrees = edge[0].forward != edge[1].forward;
    conflicts += (orientation.flip[edge[0].element] == orientation.flip[edge[1].element]) != agrees;
  });
  return conflicts;
}

}  // namespace

std::string orient_surfaces() {
  const ModelMesh mesh = read_model_mesh();
  if (has_volume_elements(mesh)) return {};
  const SurfaceElements all = collect(mesh);
  const std::vector<Side> sides = sorted_sides(mesh.points.size(), all.triangles, all.quads);
  Orientation orientation = orient_where_possible(all.places.size(), sides);
  show_fronts(mesh, all, orientation);
  std::vector<EntityMesh> entities = mesh.entities;
  std::set<std::uint32_t> changed;
  for (std::size_t e = 0; e < all.places.size(); ++e) {
    if (!orientation.flip[e]) continue;
    const Place& place = all.places[e];
    ElementBlock& block = entities[place.entity].blocks[place.block];
    if (block.order > 2)
      throw InputError(
          fmt::format("surface {} would have to be turned over, and elements of order {} cannot be; reverse it "
                      "in the geometry",
                      entities[place.entity].tag, block.order));
    turn(block, place.first);
    changed.insert(place.entity);
  }
  if (!changed.empty()) exchange(mesh, entities, changed);
  const std::size_t conflicts = count_conflicts(sides, orientation);
  if (conflicts == 0) return {};
  return fmt::format("the surfaces have no orientation, like a Moebius strip: they turn over at {} edge{}", conflicts,
                     conflicts == 1 ? "" : "s");
}

void drop_middle_nodes() {
  constexpr int kQuad8 = 16, kQuad9 = 10;
  const ModelMesh mesh = read_model_mesh();
  std::vector<EntityMesh> entities = mesh.entities;
  std::set<std::uint32_t> changed;
  std::set<std::size_t> middle;
  for (std::uint32_t e = 0; e < entities.size(); ++e)
    for (ElementBlock& block : entities[e].blocks) {
      if (block.type != kQuad9) continue;
      std::vector<std::size_t> nodes;
      for (std::size_t i = 0; i < block.nodes.size(); i += 9) {
        nodes.insert(nodes.end(), &block.nodes[i], &block.nodes[i] + 8);
        middle.insert(block.nodes[i + 8]);
      }
      block.type = kQuad8;
      block.nodes_per_element = 8;
      block.nodes = std::move(nodes);
      changed.insert(e);
    }
  if (changed.empty()) return;
  for (const EntityMesh& entity : entities)
    for (const ElementBlock& block : entity.blocks)
      for (const std::size_t node : block.nodes) middle.erase(node);  // of another element, too
  for (const std::uint32_t e : changed) {
    const EntityMesh& before = mesh.entities[e];
    EntityMesh& entity = entities[e];
    entity.node_tags.clear(), entity.xyz.clear(), entity.uv.clear();
    for (std::size_t i = 0; i < before.node_tags.size(); ++i) {
      if (middle.count(before.node_tags[i])) continue;
      entity.node_tags.push_back(before.node_tags[i]);
      entity.xyz.insert(entity.xyz.end(), &before.xyz[3 * i], &before.xyz[3 * i] + 3);
      if (!before.uv.empty()) entity.uv.insert(entity.uv.end(), &before.uv[2 * i], &before.uv[2 * i] + 2);
    }
  }
  exchange(mesh, entities, changed);
}

void drop_loose_points() {
  const ModelMesh mesh = read_model_mesh();
  std::set<std::size_t> used;
  for (const EntityMesh& entity : mesh.entities)
    for (const ElementBlock& block : entity.blocks)
      if (entity.dim > 0) used.insert(block.nodes.begin(), block.nodes.end());
  ::gmsh::vectorpair loose;
  for (const EntityMesh& entity : mesh.entities)
    if (entity.dim == 0 && std::none_of(entity.node_tags.begin(), entity.node_tags.end(),
                                        [&](std::size_t tag) { return used.count(tag) > 0; }))
      loose.emplace_back(0, entity.tag);
  if (!loose.empty()) run_logged([&] { ::gmsh::model::mesh::clear(loose); });
}

}  // namespace qmorph::adapter
