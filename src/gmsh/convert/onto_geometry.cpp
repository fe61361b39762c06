// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/convert/onto_geometry.hpp"

#include "space/move_nodes.hpp"

namespace qmorph::adapter {
namespace {

std::vector<OnInput> places_of(const std::vector<Index>& nodes, const space::Result& result, const SurfacePart& part) {
  std::vector<OnInput> places;
  places.reserve(nodes.size());
  for (const Index v : nodes) {
    const space::Foot& foot = result.foot(v);
    OnInput place{.point = result.mesh().points[v], .weights = foot.weights, .corners = {}};
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

void settle(const Lander& lander, ConvertedSurface& surface, bool may_move) {
  surface.parameters.clear();
  surface.on_geometry = {};
  for (std::size_t p = 0; p < surface.results.size(); ++p) {
    const SurfacePart& part = surface.surface.parts[p];
    QuadMesh& mesh = surface.results[p];
    const space::Result& result = surface.judged[p].on_surface();
    const std::vector<Index> nodes = space::movable_nodes(result, part.patch);
    const std::vector<Landing> landings = lander(places_of(nodes, result, part));
    auto& parameters = surface.parameters.emplace_back(mesh.points.size(), kNoParameters);
    for (std::size_t i = 0; i < nodes.size(); ++i) parameters[nodes[i]] = landings[i].parameters;
    if (may_move && !surface.judged[p].plane()) surface.on_geometry.add(move(nodes, landings, result, mesh));
  }
}

}  // namespace

void find_parameters(const Lander& lander, ConvertedSurface& surface) { settle(lander, surface, false); }

void put_onto(const Lander& lander, ConvertedSurface& surface) { settle(lander, surface, true); }

}  // namespace qmorph::adapter
