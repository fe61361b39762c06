// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/geometry/onto_geometry.hpp"

#include <limits>

#include "qmorph/check.hpp"
#include "space/move_nodes.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

std::vector<OnInput> places_of(const std::vector<Index>& nodes, const space::Result& result, const SurfacePart& part) {
  std::vector<OnInput> places;
  places.reserve(nodes.size());
  for (const Index v : nodes) {
    const space::Foot& foot = result.foot(v);
    OnInput place{result.mesh().points[v], foot.weights, {}};
    for (int i = 0; i < 3; ++i)
      place.corners[std::size_t(i)] = part.rows[result.surface().corners(foot.triangle)[std::size_t(i)]];
    places.push_back(place);
  }
  return places;
}

OnGeometry move(const std::vector<Index>& nodes, const std::vector<Landing>& landings, const space::Result& result,
                QuadMesh& mesh) {
  std::vector<space::Move> moves;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (landings[i].found) moves.push_back({nodes[i], landings[i].point});
  const std::size_t stayed = space::move_nodes(result, moves, mesh).size();
  return {moves.size() - stayed, nodes.size() - moves.size() + stayed};
}

}  // namespace

void put_onto(const Shape& shape, Onto onto, ConvertedSurface& surface) {
  surface.parameters.clear();
  surface.on_geometry = {};
  for (std::size_t p = 0; p < surface.results.size(); ++p) {
    const SurfacePart& part = surface.surface.parts[p];
    QuadMesh& mesh = surface.results[p];
    const space::Result result(part.patch, mesh);
    const std::vector<Index> nodes = space::movable_nodes(result, part.patch);
    const std::vector<Landing> landings = shape.land(places_of(nodes, result, part));
    if (shape.has_parameters()) {
      auto& parameters = surface.parameters.emplace_back(mesh.points.size(),
                                                         Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()));
      for (std::size_t i = 0; i < nodes.size(); ++i) parameters[nodes[i]] = landings[i].parameters;
    }
    if (onto == Onto::nothing || is_planar(part.patch)) continue;
    const OnGeometry moved = move(nodes, landings, result, mesh);
    surface.on_geometry.nodes += moved.nodes;
    surface.on_geometry.left += moved.left;
  }
}

}  // namespace qmorph::adapter
