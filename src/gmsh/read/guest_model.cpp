// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/guest_model.hpp"

#include <algorithm>
#include <optional>

#include "gmsh/model/node_places.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"

namespace qmorph::adapter {
namespace {

/// Whether an entity of the current model is the image of another. Versions before 4.9 move no nodes.
bool has_moved_nodes() {
#if QMORPH_GMSH_AT_LEAST(4, 9)
  for (const int dim : {0, 1, 2}) {
    ::gmsh::vectorpair entities;
    ::gmsh::model::getEntities(entities, dim);
    std::vector<int> tags, masters;
    for (const auto& entity : entities) tags.push_back(entity.second);
    ::gmsh::model::mesh::getPeriodic(dim, tags, masters);
    if (masters != tags) return true;
  }
#endif
  return false;
}

}  // namespace

GuestModel::GuestModel() {
  ::gmsh::model::getCurrent(host_);
  ::gmsh::view::getTags(views_);
  ::gmsh::model::add(host_ + " guest");
}

GuestModel::~GuestModel() {
  try {
    std::vector<int> views;
    ::gmsh::view::getTags(views);
    for (int view : views)
      if (!std::count(views_.begin(), views_.end(), view)) ::gmsh::view::remove(view);
    ::gmsh::model::remove();
    ::gmsh::model::setCurrent(host_);
  } catch (...) {  // a destructor cannot report it
  }
}

void place_nodes_as_in(const std::string& path) {
  if (!has_moved_nodes()) return;
  std::optional<NodePlaces> places;
  {
    const GuestModel guest;
    const ScopedOption ignore("Mesh.IgnorePeriodicity", 1);
    run_logged([&] { ::gmsh::merge(path); });
    places.emplace();
  }
  places->restore();
}

}  // namespace qmorph::adapter
