// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/improve.hpp"

#include <optional>

#include "engine/regions.hpp"
#include "space/faults.hpp"
#include "space/repair.hpp"
#include "space/settle.hpp"
#include "space/smooth.hpp"
#include "space/surface_normals.hpp"

namespace qmorph::space {
namespace {

/// The surface of a region, which parts at its creases.
class PartedSurface {
 public:
  explicit PartedSurface(const chart::CurvedRegion& region) : region_(region) {
    if (region.creases.empty()) return;
    std::vector<Background::Edge> edges = region.barriers;
    for (const auto& [a, b] : region.creases) edges.push_back({a, b});
    own_.emplace(region.points, region.region.triangles, edges);
  }
  const Background& operator*() const { return own_ ? *own_ : *region_.background; }

 private:
  const chart::CurvedRegion& region_;
  std::optional<const Background> own_;
};

/// Which faces lie where the surface itself is folded; what lies beyond a crease does not count.
class Folds {
 public:
  /// `unsure`: triangles that make no fold; may be empty.
  Folds(const MeshOnSurface& mesh, const Background& surface, std::span<const char> unsure)
      : mesh_(mesh), surface_(surface), unsure_(unsure) {}

  bool are_under(Index f) {
    if (!normals_) normals_.emplace(surface_);
    const chart::Face& face = mesh_.mesh().faces[f];
    const auto at = [&](Index i) -> const Eigen::Vector3d& { return mesh_.point(face[i]); };
    const Index hint = mesh_.mesh().near[f];
    return chart::degree(face) == 4
               ? is_folded_under<4>(surface_, *normals_, {at(0), at(1), at(2), at(3)}, hint, unsure_)
               : is_folded_under<3>(surface_, *normals_, {at(0), at(1), at(2)}, hint, unsure_);
  }

 private:
  const MeshOnSurface& mesh_;
  const Background& surface_;
  const std::span<const char> unsure_;
  std::optional<SurfaceNormals> normals_;  ///< made when it is asked for: most surfaces have no fold
};

/// Where the surface itself is not folded.
std::vector<Index> turned_faces(const MeshOnSurface& mesh, Folds& folds) {
  std::vector<Index> faces;
  for (const PoorFace& poor : find_poor(mesh, 0))
    if (!folds.are_under(poor.face)) faces.push_back(poor.face);
  return faces;
}

std::vector<Index> doubtful_faces(const MeshOnSurface& mesh, Folds& folds) {
  constexpr double kLeastRise = 0.2;  // with less, normals of triangles beside those at a corner may say otherwise
  std::vector<Index> faces;
  for (Index f = 0; f < mesh.faces(); ++f)
    if ((mesh.own_sine(f) <= 0 || (!mesh.is_clearly_above(f, 0) && mesh.exact_rise(f) < kLeastRise)) &&
        !folds.are_under(f))
      faces.push_back(f);
  return faces;
}

}  // namespace

std::vector<Index> find_turned(chart::SurfaceMesh mesh, const std::vector<chart::Edge>& creases,
                               const chart::CurvedRegion& region, const std::vector<char>& stretched) {
  const PartedSurface surface(region);
  const MeshOnSurface view(mesh, creases, *surface, region.whole(), stretched);
  Folds folds(view, *surface, region.unsure);
  return turned_faces(view, folds);
}

bool has_turned(chart::SurfaceMesh mesh, const chart::CurvedRegion& region) {
  const PartedSurface surface(region);
  const std::vector<chart::Edge> creases;
  const std::vector<char> stretched;
  return !find_poor(MeshOnSurface(mesh, creases, *surface, region.whole(), stretched), 0).empty();
}

Faults improve(chart::SurfaceMesh& mesh, const std::vector<chart::Edge>& creases, const chart::CurvedRegion& region,
               const std::vector<char>& stretched, const SmoothingOptions& options) {
  constexpr std::size_t kWorkOfLook = 150;
  std::size_t looks = 0;
  const WholeSurface whole = region.whole();
  const PartedSurface parted(region);
  const Background& surface = *parted;
  {
    MeshOnSurface view(mesh, creases, surface, whole, stretched);
    smooth(view, options);
    settle(view, options);
    smooth_near(view, options, raise_poor(view, options));
    raise_bent(view, options);
    const bool is_valid = find_poor(view, 0).empty();
    looks += view.exact_looks();
    if (Folds folds(view, surface, region.unsure); is_valid)
      return {{}, doubtful_faces(view, folds), kWorkOfLook * looks};
  }
  Faults faults;
  mesh = mend_in_charts(std::move(mesh), creases, region, surface, options, faults.work);
  MeshOnSurface view(mesh, creases, surface, whole, stretched);
  smooth_near(view, options, raise_poor(view, options));
  raise_bent(view, options);
  Folds folds(view, surface, region.unsure);
  faults.turned = turned_faces(view, folds);
  if (faults.turned.empty()) faults.doubtful = doubtful_faces(view, folds);
  faults.work += kWorkOfLook * (looks + view.exact_looks());
  return faults;
}

}  // namespace qmorph::space
