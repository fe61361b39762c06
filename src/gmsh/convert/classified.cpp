// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/convert/classified.hpp"

#include <fmt/format.h>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

void refuse_ghost_cells(const ModelMesh& mesh) {
  for (const EntityMesh& entity : mesh.entities)
    if (entity_type(entity.dim, entity.tag).rfind("Ghost", 0) == 0)
      throw InputError(
          fmt::format("the mesh is partitioned with ghost cells (entity {} of dimension {}); partition it "
                      "after the conversion",
                      entity.tag, entity.dim));
}

}  // namespace

ClassifiedMesh read_classified_mesh(std::vector<std::string>& warnings) {
  ClassifiedMesh model;
  model.mesh = read_model_mesh();
  refuse_ghost_cells(model.mesh);
  model.use = find_node_use(model.mesh);
  if (!is_misclassified(model.mesh, model.use)) return model;

  // Gmsh's reclassification forgets nodes on points and curves that have no elements; they stay fixed all the same.
  std::vector<std::size_t> pinned_tags;
  for (Index row = 0; row < model.mesh.tags.size(); ++row)
    if (model.use.pinned[row]) pinned_tags.push_back(model.mesh.tags[row]);
  const StageLog log = run_logged([] { ::gmsh::model::mesh::reclassifyNodes(); });
  if (!log.errors.empty()) throw InputError("Gmsh cannot classify the nodes: " + first_errors(log));
  warnings.push_back("the file has nodes in entities that do not use them; they have been classified again");
  model.mesh = read_model_mesh();
  model.use = find_node_use(model.mesh, pinned_tags);
  return model;
}

}  // namespace qmorph::adapter
