#include "gmsh/periodic.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "gmsh/check.hpp"
#include "gmsh/compat.hpp"
#include "gmsh/scratch_file.hpp"
#include "gmsh/session.hpp"
#include "kernel/sort_unique.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

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

[[noreturn]] void refuse_image(const PeriodicLink& link) {
  throw SurfaceError(
      fmt::format("it is periodic with surface {}, and its mesh is not the image of that one's", link.master));
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

Eigen::Vector3d transformed(const std::vector<double>& t, const Eigen::Vector3d& p) {
  Eigen::Vector3d q;
  for (int i = 0; i < 3; ++i) q[i] = t[4 * i] * p.x() + t[4 * i + 1] * p.y() + t[4 * i + 2] * p.z() + t[4 * i + 3];
  return q;
}

}  // namespace

std::vector<PeriodicLink> read_periodic_links(const ModelMesh& mesh, int dim) {
  std::vector<PeriodicLink> links;
  for (const EntityMesh& entity : mesh.entities) {
    if (entity.dim != dim) continue;
    PeriodicLink link;
    link.dim = dim;
    link.slave = link.master = entity.tag;
    std::vector<std::size_t> nodes, masters;
    ::gmsh::model::mesh::getPeriodicNodes(dim, link.slave, link.master, nodes, masters, link.transformation, true);
    if (link.master == link.slave || nodes.empty()) continue;
    for (std::size_t i = 0; i < nodes.size(); ++i) link.nodes.emplace_back(nodes[i], masters[i]);
    std::sort(link.nodes.begin(), link.nodes.end());  // Gmsh's order depends on where the nodes are in memory
    links.push_back(std::move(link));
  }
  return links;
}

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
    throw SurfaceError(fmt::format("it is periodic with surface {}, and nothing says how", link.master));
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
      throw SurfaceError(fmt::format("it is periodic with surface {}, and has quads already", link.master));
    const std::vector<Index> image = image_of_part(link, rows, part, *found);
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
    if (patch_normal(shape).dot(patch_normal(patch)) < 0) {
      for (auto& triangle : result.triangles) std::reverse(triangle.begin(), triangle.end());
      for (auto& quad : result.quads) std::reverse(quad.begin(), quad.end());
    }
    results.push_back(std::move(result));
  }
  return results;
}

void add_high_order_pairs(const ModelMesh& mesh, PeriodicLink& link) {
  using Corners = std::set<std::size_t>;
  struct Element {
    Corners corners;
    std::vector<std::size_t> others;
  };
  const auto elements_of = [&](int surface) {
    std::vector<Element> elements;
    for (const EntityMesh& entity : mesh.entities)
      for (const ElementBlock& block : entity.blocks)
        for (std::size_t i = 0; entity.dim == 2 && entity.tag == surface && i < block.nodes.size();
             i += block.nodes_per_element) {
          const auto at = block.nodes.begin() + static_cast<std::ptrdiff_t>(i);
          const auto inner = at + static_cast<std::ptrdiff_t>(block.corners);
          elements.push_back({{at, inner}, {inner, at + static_cast<std::ptrdiff_t>(block.nodes_per_element)}});
        }
    return elements;
  };
  const std::map<std::size_t, std::size_t> master_of(link.nodes.begin(), link.nodes.end());
  std::map<Corners, std::vector<std::size_t>> masters;
  for (Element& element : elements_of(link.master)) masters[element.corners] = std::move(element.others);
  std::set<std::pair<std::size_t, std::size_t>> pairs(link.nodes.begin(), link.nodes.end());
  for (const Element& element : elements_of(link.slave)) {
    Corners image;
    for (std::size_t tag : element.corners)
      if (const auto found = master_of.find(tag); found != master_of.end()) image.insert(found->second);
    const auto master = masters.find(image);
    if (master == masters.end()) continue;
    for (std::size_t tag : master->second) {
      const Eigen::Vector3d p = transformed(link.transformation, mesh.points[mesh.rows.find(tag)]);
      const auto distance = [&](std::size_t slave) { return (mesh.points[mesh.rows.find(slave)] - p).squaredNorm(); };
      const auto nearest = std::min_element(element.others.begin(), element.others.end(),
                                            [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
      if (nearest != element.others.end()) pairs.emplace(*nearest, tag);
    }
  }
  link.nodes.assign(pairs.begin(), pairs.end());
}

/// No call sets them, but a file with nothing else in it does, when it is merged.
void restore_links(const std::vector<PeriodicLink>& links) {
  if (links.empty()) return;
  const ScratchFile file(".msh");
  {
    std::ofstream out(file.path(), std::ios::binary);
    out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Periodic\n" << links.size() << '\n';
    for (const PeriodicLink& link : links) {
      out << fmt::format("{} {} {}\n{} {}\n{}\n", link.dim, link.slave, link.master, link.transformation.size(),
                         fmt::join(link.transformation, " "), link.nodes.size());
      for (const auto& [slave, master] : link.nodes) out << slave << ' ' << master << '\n';
    }
    out << "$EndPeriodic\n";
    if (!out.flush()) throw InputError("cannot write to the temporary file " + file.path());
  }
  const ScopedOption read_them("Mesh.IgnorePeriodicity", 0);
  const StageLog log = run_logged([&] { ::gmsh::merge(file.path()); });
  if (!log.errors.empty()) throw InputError("Gmsh cannot keep the periodic surfaces: " + first_errors(log));
}

}  // namespace qmorph::adapter
