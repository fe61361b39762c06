// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/geometry/landing.hpp"

#include <memory>

#include "gmsh/geometry/cad_surface.hpp"
#include "gmsh/geometry/curved_triangles.hpp"

namespace qmorph::adapter {
namespace {

template <class Surface>
Lander lander_of(std::shared_ptr<const Surface> surface) {
  return [surface](std::span<const OnInput> points) { return surface->land(points); };
}

}  // namespace

Lander find_lander(const ModelMesh& mesh, std::uint32_t entity) {
  if (auto surface = CadSurface::find(mesh, entity)) return lander_of<CadSurface>(std::move(surface));
  if (auto surface = CurvedTriangles::find(mesh, entity)) return lander_of<CurvedTriangles>(std::move(surface));
  return {};
}

}  // namespace qmorph::adapter
