// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/put_back.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "gmsh/model/add_elements.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

void add_nodes(const EntityMesh& entity) {
  if (!entity.node_tags.empty())
    ::gmsh::model::mesh::addNodes(entity.dim, entity.tag, entity.node_tags, entity.xyz, entity.uv);
}

/// For each entity, the others whose elements use nodes that it owns.
std::vector<std::set<std::uint32_t>> find_users(const ModelMesh& mesh) {
  std::vector<std::set<std::uint32_t>> users(mesh.entities.size());
  for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
    std::uint32_t last = e;  // neighbours in the list mostly have one owner
    for (const ElementBlock& block : mesh.entities[e].blocks)
      for (std::size_t tag : block.nodes) {
        const Index row = mesh.rows.find(tag);
        if (row == kNone || mesh.owner[row] == last || mesh.owner[row] == e) continue;
        last = mesh.owner[row];
        users[last].insert(e);
      }
  }
  return users;
}

void clear_and_refill(const ModelMesh& mesh, const std::vector<Replacement>& replacements) {
  std::map<std::uint32_t, const EntityMesh*> fresh;
  std::vector<std::uint32_t> changed;
  for (const Replacement& replacement : replacements) {
    fresh[replacement.entity] = replacement.fresh;
    changed.push_back(replacement.entity);
  }
  std::vector<const EntityMesh*> refill;
  for (std::uint32_t e : find_cleared(mesh, changed))
    refill.push_back(fresh.count(e) ? fresh.at(e) : &mesh.entities[e]);
  ::gmsh::vectorpair to_clear;
  for (auto it = refill.rbegin(); it != refill.rend(); ++it)  // volumes come last in the model
    to_clear.emplace_back((*it)->dim, (*it)->tag);
  ::gmsh::model::mesh::clear(to_clear);
  for (const EntityMesh* entity : refill) add_nodes(*entity);
  add_elements(refill, mesh.tags.size());
}

}  // namespace

std::vector<std::uint32_t> find_cleared(const ModelMesh& mesh, const std::vector<std::uint32_t>& changed) {
  const auto users = find_users(mesh);
  std::map<std::pair<int, int>, std::uint32_t> index;
  for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) index[{mesh.entities[e].dim, mesh.entities[e].tag}] = e;
  const bool only_surfaces =
      std::all_of(changed.begin(), changed.end(), [&](std::uint32_t e) { return mesh.entities[e].dim >= 2; });
  std::set<std::uint32_t> cleared;
  std::vector<std::uint32_t> open = changed;
  while (!open.empty()) {
    const std::uint32_t e = open.back();
    open.pop_back();
    if (!cleared.insert(e).second) continue;
    const EntityMesh& entity = mesh.entities[e];
    if (entity.dim < 2 && only_surfaces)
      throw InputError(fmt::format("nodes of a surface belong to {} {}, which cannot be put back; classify the nodes",
                                   entity.dim ? "curve" : "point", entity.tag));
    open.insert(open.end(), users[e].begin(), users[e].end());
    std::vector<int> up, down;
    if (entity.dim == 1 || entity.dim == 2) ::gmsh::model::getAdjacencies(entity.dim, entity.tag, up, down);
    for (int tag : up)
      if (const auto found = index.find({entity.dim + 1, tag});
          found != index.end() && mesh.entities[found->second].element_count())
        open.push_back(found->second);
  }
  return {cleared.begin(), cleared.end()};
}

void put_back(const ModelMesh& mesh, const std::vector<Replacement>& replacements) {
  const StageLog log = run_logged([&] { clear_and_refill(mesh, replacements); });
  if (!log.errors.empty()) throw InputError("Gmsh cannot take the new elements back: " + first_errors(log));
  // Gmsh says it as a warning, and then nothing has been cleared.
  for (const std::string& warning : log.warnings)
    if (warning.find("Cannot delete mesh") != std::string::npos)
      throw InputError("Gmsh cannot take the new elements back: " + warning);
}

}  // namespace qmorph::adapter
