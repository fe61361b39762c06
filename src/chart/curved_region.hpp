// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A region of a curved surface.

#include <memory>

#include "chart/surface_mesh.hpp"
#include "space/reference.hpp"
#include "space/whole_surface.hpp"
#include "stretch/metric_field.hpp"

namespace qmorph::chart {

/// A patch as a surface.
struct WholePatch {
  space::Reference reference;
  space::SurfaceNormals normals;

  explicit WholePatch(const Patch& patch) : reference(patch), normals(reference.surface) {}
};

struct CurvedRegion {
  /// As cut_into_regions() makes it; its points in the plane mean nothing.
  Region region;
  std::vector<Eigen::Vector3d> points;
  std::vector<space::Background::Edge> barriers;
  std::unique_ptr<const space::Background> background;
  std::vector<std::pair<Index, Index>> creases;  ///< edges, lower vertex first, sorted
  std::vector<Index> tips;  ///< vertices inside where the surface is as sharp as a crease: the tip of a cone

  CurvedRegion(const Patch& patch, Region cut, double crease_angle);
  /// Its elements, before anything is done to them. Triangles of the patch from row `first_half` on are halves of
  /// quads, two and two.
  SurfaceMesh start() const;
  /// The surface itself: a face for each triangle.
  SurfaceMesh triangles() const;
  std::size_t first_half = std::size_t(-1);
  std::vector<char> unsure;                  ///< by triangle: space::unsure_ground(); empty if none is
  std::shared_ptr<const WholePatch> beside;  ///< null if no quads lie beside it
  /// The surface that it is a part of, with the quads of the patch that stay.
  space::WholeSurface whole() const {
    if (!beside) return {*background};
    return {beside->reference.surface, {beside, &beside->normals}, region.row};
  }
  /// How the triangles are stretched; null if they are not.
  const stretch::MetricField* stretch() const { return stretch_.get(); }

 private:
  /// \param other the other half of the quad that a triangle is a half of, or kNone
  SurfaceMesh joined(const std::vector<Index>& other) const;
  void drop_creases_of_facets();
  void find_tips(double least);
  void find_stretch();

  std::unique_ptr<const stretch::MetricField> stretch_;
};

/// The regions of a patch of triangles; `first_half` as above.
std::vector<CurvedRegion> curved_regions(const Patch& patch, double crease_angle, std::size_t first_half = -1);

}  // namespace qmorph::chart
