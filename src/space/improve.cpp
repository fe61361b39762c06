// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/improve.hpp"

#include "engine/regions.hpp"
#include "space/faults.hpp"
#include "space/repair.hpp"
#include "space/settle.hpp"
#include "space/smooth.hpp"

namespace qmorph::space {
namespace {

std::vector<Background::Edge> barriers(const chart::CurvedRegion& region) {
  std::vector<Background::Edge> edges = region.barriers;
  for (const auto& [a, b] : region.creases) edges.push_back({a, b});
  return edges;
}

bool is_folded_under(const MeshOnSurface& mesh, Index f) {
  const chart::Face& face = mesh.mesh().faces[f];
  const auto at = [&](Index i) -> const Eigen::Vector3d& { return mesh.point(face[i]); };
  const Index hint = mesh.mesh().near[f];
  return chart::degree(face) == 4
             ? is_folded_under<4>(mesh.whole(), mesh.whole_normals(), {at(0), at(1), at(2), at(3)}, hint)
             : is_folded_under<3>(mesh.whole(), mesh.whole_normals(), {at(0), at(1), at(2)}, hint);
}

std::vector<Index> doubtful_faces(const MeshOnSurface& mesh) {
  constexpr double kLeastRise = 0.1;
  std::vector<Index> faces;
  for (Index f = 0; f < mesh.faces(); ++f)
    if (!mesh.is_clearly_above(f, 0) && mesh.exact_rise(f) < kLeastRise && !is_folded_under(mesh, f))
      faces.push_back(f);
  return faces;
}

}  // namespace

Faults improve(chart::SurfaceMesh& mesh, const std::vector<chart::Edge>& creases, const chart::CurvedRegion& region,
               const SmoothingOptions& options) {
  const Background surface(region.points, region.region.triangles, barriers(region));
  {
    MeshOnSurface view(mesh, creases, surface, *region.background);
    smooth(view, options);
    settle(view, options);
    smooth_near(view, options, raise_poor(view, options));
    if (find_poor(view, 0).empty()) return {{}, doubtful_faces(view)};
  }
  mesh = mend_in_charts(std::move(mesh), creases, region, surface, options);
  MeshOnSurface view(mesh, creases, surface, *region.background);
  smooth_near(view, options, raise_poor(view, options));
  Faults faults;
  for (const PoorFace& poor : find_poor(view, 0))
    if (!is_folded_under(view, poor.face)) faults.turned.push_back(poor.face);
  if (faults.turned.empty()) faults.doubtful = doubtful_faces(view);
  return faults;
}

}  // namespace qmorph::space
