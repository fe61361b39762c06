// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/node_places.hpp"

#include <algorithm>

#include "gmsh/model/model_mesh.hpp"
#include "gmsh/session/compat.hpp"

namespace qmorph::adapter {
namespace {

void read_all(std::vector<std::size_t>& tags, std::vector<double>& xyz) {
  std::vector<double> parameters;
  ::gmsh::model::mesh::getNodes(tags, xyz, parameters, -1, -1, false, false);
}

}  // namespace

NodePlaces::NodePlaces() { read_all(tags_, xyz_); }

void NodePlaces::restore() const {
  std::vector<std::size_t> tags;
  std::vector<double> xyz;
  read_all(tags, xyz);
  if (tags == tags_ && xyz == xyz_) return;
  const NodeRows rows(tags_);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const Index row = rows.find(tags[i]);
    if (row == kNone) continue;
    const auto place = xyz_.begin() + std::ptrdiff_t(3 * row);
    if (std::equal(place, place + 3, xyz.begin() + std::ptrdiff_t(3 * i))) continue;
    ::gmsh::model::mesh::setNode(tags[i], {place, place + 3}, placed_node(tags[i]).parameters);
  }
}

}  // namespace qmorph::adapter
