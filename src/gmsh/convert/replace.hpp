// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Puts converted surfaces back into the current Gmsh model.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "gmsh/model/curved_elements.hpp"
#include "gmsh/model/model_mesh.hpp"
#include "gmsh/model/patches.hpp"
#include "qmorph/gmsh.hpp"
#include "qmorph/patch.hpp"
#include "qmorph/report.hpp"
#include "quality/judged.hpp"

namespace qmorph::adapter {

/// A surface and, for each of its parts, what the engine made of it.
struct ConvertedSurface {
  SurfaceMesh surface;
  std::vector<QuadMesh> results;
  std::vector<Judged> judged{};  ///< of each part, as its nodes are now: between settling and the figures
  ConversionReport report{};     ///< of all parts together
  /// Of each part's nodes those on the surface of a geometry, NaN for what stays from the input; empty: not known.
  std::vector<std::vector<Eigen::Vector2d>> parameters{};
  OnGeometry on_geometry{};
  std::vector<CurvedElements> curved{};  ///< of each part; empty for linear elements
  std::string bent{};  ///< where curved sides of the input turn elements over, as they did triangles; or empty
};

/// Node tags of the results of one surface's parts.
using PartTags = std::vector<std::vector<std::size_t>>;

/// Replaces the elements and the inner nodes of the surfaces. Kept nodes keep their tags and new ones get tags above
/// all others; the tags of the elements that go are used again, so that the numbering has few gaps.
/// \pre nodes are classified (`is_misclassified` is false), `mesh` is the model's mesh as it is now
/// \return node tags of each surface, for each part, in the order of the result's points
/// \throws InputError if Gmsh refuses a step. The model must not be written then.
std::vector<PartTags> replace_surfaces(const ModelMesh& mesh, const std::vector<ConvertedSurface>& surfaces);

}  // namespace qmorph::adapter
