// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <memory>
#include <span>

#include "space/surface_normals.hpp"

namespace qmorph::space {

/// The surface that a region is a part of, as those see it who judge a result: not parted at creases, and with what
/// lies beside the region.
class WholeSurface {
 public:
  /// There is nothing beside the region. The surface must outlive this.
  WholeSurface(const Background& surface)
      : surface_(&surface), normals_(std::make_shared<const SurfaceNormals>(surface)) {}
  /// `row`: of each of the region's triangles, in the surface. All must outlive this.
  WholeSurface(const Background& surface, std::shared_ptr<const SurfaceNormals> normals, std::span<const Index> row)
      : surface_(&surface), normals_(std::move(normals)), row_(row) {}

  const SurfaceNormals& normals() const { return *normals_; }
  /// Where a triangle of the region is in the surface.
  Index row(Index triangle) const { return row_.empty() ? triangle : row_[triangle]; }
  double clear_cosine(Index triangle) const { return surface_->clear_cosine(row(triangle)); }

 private:
  const Background* surface_;
  std::shared_ptr<const SurfaceNormals> normals_;
  std::span<const Index> row_;
};

}  // namespace qmorph::space
