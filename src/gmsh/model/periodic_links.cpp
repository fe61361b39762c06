// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/periodic_links.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "gmsh/model/node_places.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/scratch_file.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {

Eigen::Vector3d transformed(const std::vector<double>& t, const Eigen::Vector3d& p) {
  Eigen::Vector3d q;
  for (int i = 0; i < 3; ++i) q[i] = t[4 * i] * p.x() + t[4 * i + 1] * p.y() + t[4 * i + 2] * p.z() + t[4 * i + 3];
  return q;
}

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
  const NodePlaces places;
  const ScopedOption read_them("Mesh.IgnorePeriodicity", 0);
  // Gmsh looks for the nodes of entities that are no images of others, and complains where it has no library for that.
  const ScopedOption errors_only("General.Verbosity", 1);
  const StageLog log = run_logged([&] { ::gmsh::merge(file.path()); });
  if (!log.errors.empty()) throw InputError("Gmsh cannot keep the periodic surfaces: " + first_errors(log));
  places.restore();
}

}  // namespace qmorph::adapter
