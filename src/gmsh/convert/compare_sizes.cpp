// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/convert/compare_sizes.hpp"

#include <fmt/format.h>

#include "gmsh/model/model_mesh.hpp"
#include "quality/directed_size.hpp"

namespace qmorph::adapter {
namespace {

template <std::size_t N>
void read_elements(const ModelMesh& mesh, const ElementBlock* block, std::vector<std::array<Index, N>>& elements) {
  if (!block) return;
  for (std::size_t e = 0; e < block->tags.size(); ++e) {
    std::array<Index, N> corners{};
    for (std::size_t k = 0; k < N; ++k) {
      corners[k] = mesh.rows.find(block->nodes[e * block->nodes_per_element + k]);
      if (corners[k] == kNone)
        throw InputError(fmt::format("element {} uses a node that the mesh does not have", block->tags[e]));
    }
    elements.push_back(corners);
  }
}

/// Drops the points of other surfaces.
void number_points(const std::vector<Eigen::Vector3d>& all, std::vector<Index>& number, Patch& patch) {
  std::vector<Index> used;
  const auto take = [&](auto& elements) {
    for (auto& element : elements)
      for (Index& v : element) {
        if (number[v] == kNone) {
          number[v] = Index(used.size());
          used.push_back(v);
          patch.points.push_back(all[v]);
        }
        v = number[v];
      }
  };
  take(patch.triangles);
  take(patch.quads);
  for (Index v : used) number[v] = kNone;
}

}  // namespace

std::map<int, Patch> read_surfaces() {
  const ModelMesh mesh = read_model_mesh();
  std::vector<Index> number(mesh.points.size(), kNone);
  std::map<int, Patch> surfaces;
  for (const EntityMesh& entity : mesh.entities) {
    if (entity.dim != 2 || entity.element_count() == 0) continue;
    Patch& patch = surfaces[entity.tag];
    read_elements(mesh, entity.polygons(3), patch.triangles);
    read_elements(mesh, entity.polygons(4), patch.quads);
    number_points(mesh.points, number, patch);
  }
  return surfaces;
}

void compare_sizes(const std::map<int, Patch>& before, ModelReport& model) {
  const std::map<int, Patch> now = read_surfaces();
  for (SurfaceReport& surface : model.surfaces) {
    const auto was = before.find(surface.tag), is = now.find(surface.tag);
    if (was == before.end() || is == now.end()) continue;
    surface.conversion.sizes = directed_sizes(was->second, is->second.points, is->second.quads);
  }
}

}  // namespace qmorph::adapter
