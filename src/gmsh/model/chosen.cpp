// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/chosen.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "gmsh/session/compat.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

/// The tag of the entity that this one is a part of, if it has the same dimension, or its own: curves between the parts
/// of a surface have that surface for a parent.
int whole_of(const EntityMesh& entity) {
  int parent_dim = -1, parent = -1;
  ::gmsh::model::getParent(entity.dim, entity.tag, parent_dim, parent);
  return parent_dim == entity.dim ? parent : entity.tag;
}

}  // namespace

std::vector<std::uint32_t> find_chosen(const ModelMesh& mesh, int dim, const std::vector<int>& tags) {
  const auto is_wanted = [&](int tag) { return std::count(tags.begin(), tags.end(), tag) > 0; };
  std::vector<int> missing = tags;
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
    const EntityMesh& entity = mesh.entities[e];
    if (entity.dim != dim) continue;
    const int whole = whole_of(entity);
    if (!is_wanted(entity.tag) && !is_wanted(whole)) continue;
    chosen.push_back(e);
    std::erase(missing, entity.tag);
    std::erase(missing, whole);
  }
  if (missing.empty()) return chosen;
  const auto kind = dim == 2 ? ErrorSubject::Kind::surface : ErrorSubject::Kind::curve;
  throw UsageError(fmt::format("the model has no {} {}", dim == 2 ? "surface" : "curve", missing.front()),
                   {.kind = ErrorKind::no_such_entity, .subject = ErrorSubject{kind, std::size_t(missing.front())}});
}

std::vector<std::uint32_t> choose_surfaces(const ModelMesh& mesh, const std::vector<int>& tags) {
  if (!tags.empty()) return find_chosen(mesh, 2, tags);
  std::vector<std::uint32_t> all;
  for (std::uint32_t e = 0; e < mesh.entities.size(); ++e)
    if (mesh.entities[e].dim == 2) all.push_back(e);
  return all;
}

}  // namespace qmorph::adapter
