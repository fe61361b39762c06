// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/window/snapshot.hpp"

#include "gmsh/model/add_elements.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"

namespace qmorph::adapter {

Snapshot take_snapshot() {
  Snapshot snapshot{read_model_mesh(), {}};
  for (int dim : {0, 1, 2})
    for (PeriodicLink& link : read_periodic_links(snapshot.mesh, dim)) snapshot.links.push_back(std::move(link));
  return snapshot;
}

void restore(const Snapshot& snapshot) {
  const ScopedOption quiet("General.Verbosity", 2);  // the file is ours; the user need not know that it is read
  const StageLog log = run_logged([&] {
    ::gmsh::model::mesh::clear();
    std::vector<const EntityMesh*> filled;
    for (const EntityMesh& entity : snapshot.mesh.entities) {
      if (!entity.node_tags.empty())
        ::gmsh::model::mesh::addNodes(entity.dim, entity.tag, entity.node_tags, entity.xyz, entity.uv);
      if (!entity.blocks.empty()) filled.push_back(&entity);
    }
    add_elements(filled, snapshot.mesh.tags.size());
  });
  if (!log.errors.empty()) throw InputError("Gmsh cannot take the mesh back: " + first_errors(log));
  restore_links(snapshot.links);
}

void clear_mesh() {
  run_logged([] { ::gmsh::model::mesh::clear(); });
}

}  // namespace qmorph::adapter
