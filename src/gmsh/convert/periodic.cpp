// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/convert/periodic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "gmsh/model/high_order.hpp"
#include "kernel/sort_unique.hpp"
#include "qmorph/check.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

/// How far a node may be from where the transformation puts its master's, in lengths of the shortest edge at it: files
/// round, and Gmsh gives a node that a file has no pair for the nearest one, however far that is.
constexpr double kImageTolerance = 0.01;

/// From rows of the master's nodes to rows of the slave's.
std::map<Index, Index> row_map(const PeriodicLink& link, const ModelMesh& mesh) {
  std::map<Index, Index> rows;
  for (const auto& [slave, master] : link.nodes) rows[mesh.rows.find(master)] = mesh.rows.find(slave);
  return rows;
}

std::map<Index, Index> local_numbers(const SurfacePart& part) {
  std::map<Index, Index> local;
  for (Index i = 0; i < part.rows.size(); ++i) local[part.rows[i]] = i;
  return local;
}

/// "periodic with surface 3"
std::string relation(const PeriodicLink& link) {
  return fmt::format("{} surface {}", link.is_extrusion ? "extruded from" : "periodic with", link.master);
}

ErrorDetails periodic_with(const PeriodicLink& link) {
  return {.kind = ErrorKind::periodic, .subject = ErrorSubject{ErrorSubject::Kind::surface, std::size_t(link.master)}};
}

[[noreturn]] void refuse_image(const PeriodicLink& link) {
  throw SurfaceError(fmt::format("it is {}, and its mesh is not the image of that one's", relation(link)),
                     periodic_with(link));
}

/// Local numbers of the slave's part for those of the master's.
std::vector<Index> image_of_part(const PeriodicLink& link, const std::map<Index, Index>& rows,
                                 const SurfacePart& master, const SurfacePart& slave) {
  const std::map<Index, Index> local = local_numbers(slave);
  std::vector<Index> image;
  for (Index row : master.rows) {
    const auto slave_row = rows.find(row);
    if (slave_row == rows.end()) refuse_image(link);
    const auto found = local.find(slave_row->second);
    if (found == local.end()) refuse_image(link);
    image.push_back(found->second);
  }
  if (slave.rows.size() != master.rows.size() || slave.patch.triangles.size() != master.patch.triangles.size() ||
      slave.patch.quads.size() != master.patch.quads.size())
    refuse_image(link);
  return image;
}

/// For each point the length of the shortest edge at it.
std::vector<double> shortest_edges(const Patch& patch) {
  std::vector<double> shortest(patch.points.size(), std::numeric_limits<double>::infinity());
  const auto visit = [&](const auto& polygons) {
    for (const auto& polygon : polygons)
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Index a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double length = (patch.points[a] - patch.points[b]).norm();
        shortest[a] = std::min(shortest[a], length);
        shortest[b] = std::min(shortest[b], length);
      }
  };
  visit(patch.triangles);
  visit(patch.quads);
  return shortest;
}

/// Pairs alone do not make an image: each node has to be where its master's is moved to, and no two in one place.
void check_places(const PeriodicLink& link, const Patch& master, const Patch& slave, const std::vector<Index>& image) {
  const std::vector<double> shortest = shortest_edges(slave);
  std::vector<bool> taken(image.size());
  for (Index i = 0; i < image.size(); ++i) {
    const Eigen::Vector3d place = transformed(link.transformation, master.points[i]);
    const bool fits = (slave.points[image[i]] - place).norm() <= kImageTolerance * shortest[image[i]];
    if (!fits || taken[image[i]]) refuse_image(link);
    taken[image[i]] = true;
  }
}

}  // namespace

std::size_t PeriodicFamily::master_of(std::size_t member) const {
  return static_cast<std::size_t>(std::find(members.begin(), members.end(), link[member]->master) - members.begin());
}

std::vector<PeriodicFamily> find_families(const std::vector<PeriodicLink>& links) {
  std::map<int, const PeriodicLink*> link_of;
  std::set<int> masters;
  for (const PeriodicLink& link : links) {
    link_of[link.slave] = &link;
    masters.insert(link.master);
  }
  std::vector<PeriodicFamily> families;
  for (int root : masters) {
    if (link_of.count(root)) continue;
    PeriodicFamily family{{root}, {nullptr}};
    for (std::size_t i = 0; i < family.members.size(); ++i)
      for (const PeriodicLink& link : links)
        if (link.master == family.members[i]) {
          family.members.push_back(link.slave);
          family.link.push_back(&link);
        }
    families.push_back(std::move(family));
  }
  return families;
}

void match_parts(const PeriodicLink& link, const ModelMesh& mesh, SurfaceMesh& master, SurfaceMesh& slave) {
  if (link.transformation.size() != 16)
    throw SurfaceError(fmt::format("it is {}, and nothing says how", relation(link)), periodic_with(link));
  const std::map<Index, Index> rows = row_map(link, mesh);
  if (slave.parts.size() != master.parts.size()) refuse_image(link);
  std::vector<SurfacePart> ordered;
  for (SurfacePart& part : master.parts) {
    const auto first = rows.find(part.rows.front());
    const auto found = std::find_if(slave.parts.begin(), slave.parts.end(), [&](const SurfacePart& candidate) {
      return first != rows.end() && std::count(candidate.rows.begin(), candidate.rows.end(), first->second);
    });
    if (found == slave.parts.end()) refuse_image(link);
    if (!found->patch.quads.empty() && !found->quad_tags.empty())
      throw SurfaceError(fmt::format("it is {}, and has quads already", relation(link)), periodic_with(link));
    const std::vector<Index> image = image_of_part(link, rows, part, *found);
    check_places(link, part.patch, found->patch, image);
    std::vector<Index> back(image.size());
    for (Index i = 0; i < image.size(); ++i) back[image[i]] = i;
    for (Index i : found->patch.fixed) part.patch.fixed.push_back(back[i]);
    for (const auto& [a, b] : found->patch.constraints)
      part.patch.constraints.push_back({std::min(back[a], back[b]), std::max(back[a], back[b])});
    sort_unique(part.patch.fixed);
    sort_unique(part.patch.constraints);
    ordered.push_back(*found);
  }
  slave.parts = std::move(ordered);
}

std::vector<QuadMesh> copy_results(const PeriodicLink& link, const ConvertedSurface& master, const SurfaceMesh& slave,
                                   const ModelMesh& mesh) {
  const std::map<Index, Index> rows = row_map(link, mesh);
  std::vector<QuadMesh> results;
  for (std::size_t p = 0; p < master.results.size(); ++p) {
    const SurfacePart& from = master.surface.parts[p];
    const Patch& patch = slave.parts[p].patch;
    const std::vector<Index> image = image_of_part(link, rows, from, slave.parts[p]);
    QuadMesh result = master.results[p];
    for (Index i = 0; i < result.points.size(); ++i) {
      const Index source = result.source[i];
      const bool at_rest = source != kNone && result.points[i] == from.patch.points[source];
      if (source != kNone) result.source[i] = image[source];
      result.points[i] = at_rest ? patch.points[image[source]] : transformed(link.transformation, result.points[i]);
    }
    Patch shape;
    shape.points = result.points;
    shape.triangles = result.triangles;
    shape.quads = result.quads;
    if (mean_normal(shape).dot(mean_normal(patch)) < 0) {
      for (auto& triangle : result.triangles) std::reverse(triangle.begin(), triangle.end());
      for (auto& quad : result.quads) std::reverse(quad.begin(), quad.end());
    }
    results.push_back(std::move(result));
  }
  return results;
}

void restore_periodicity(const ModelMesh& mesh, const std::vector<ConvertedSurface>& converted,
                         const std::vector<PartTags>& part_tags, std::vector<PeriodicLink>& links) {
  std::map<int, std::size_t> index;
  for (std::size_t i = 0; i < converted.size(); ++i) index[mesh.entities[converted[i].surface.entity].tag] = i;
  if (index.empty()) return;
  std::optional<ModelMesh> now;
  for (PeriodicLink& link : links) {
    if (link.is_extrusion) continue;
    const auto slave = index.find(link.slave), master = index.find(link.master);
    if (slave == index.end() || master == index.end()) continue;
    link.nodes.clear();
    for (std::size_t p = 0; p < part_tags[slave->second].size(); ++p)
      for (std::size_t i = 0; i < part_tags[slave->second][p].size(); ++i)
        link.nodes.emplace_back(part_tags[slave->second][p][i], part_tags[master->second][p][i]);
    if (order_of(mesh.entities[converted[slave->second].surface.entity]) == 1) continue;
    if (!now) now = read_model_mesh();
    add_high_order_pairs(*now, link);
  }
  std::erase_if(links, [](const PeriodicLink& link) { return link.is_extrusion; });
  restore_links(links);
}

}  // namespace qmorph::adapter
