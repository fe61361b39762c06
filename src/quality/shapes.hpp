// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Shape figures of the elements of a surface, flat or in space: one definition for whoever measures.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "qmorph/export.hpp"
#include "qmorph/patch.hpp"
#include "qmorph/quality.hpp"
#include "space/corners.hpp"

namespace qmorph {

class Judged;

struct ElementShape {
  double scaled_jacobian = 1;
  double smallest_angle_deg = 90, largest_angle_deg = 90;
  double eta = 1;  ///< of a quad
  double thesis_metric = 1;
};

/// Elements of one surface, as spans into arrays that outlive it.
struct SurfaceElements {
  std::span<const Eigen::Vector3d> points;
  std::span<const std::array<Index, 3>> triangles;
  std::span<const std::array<Index, 4>> quads;
};

/// The unit normal that all elements follow, if they lie in one plane.
std::optional<Eigen::Vector3d> common_normal(const SurfaceElements& mesh);

/// The unit normal of a surface whose nodes lie in one plane, as far as the engine takes it for one.
std::optional<Eigen::Vector3d> plane_normal(const Patch& patch);

class QMORPH_API Shapes {
 public:
  /// Elements in a plane with this unit normal.
  Shapes(const SurfaceElements& mesh, const Eigen::Vector3d& normal);
  /// Elements of which nothing is known: in a plane if they have one, else judged by those around them.
  explicit Shapes(const SurfaceElements& mesh);
  /// What a surface was made into: in its plane if it has one, else judged by its triangles (and quads). `judged` must
  /// outlive this.
  explicit Shapes(Judged& judged);
  ~Shapes();
  Shapes(Shapes&&) noexcept;

  ElementShape triangle(Index t) const { return shape<3>(t, mesh_.triangles[t]); }
  ElementShape quad(Index q) const { return shape<4>(Index(mesh_.triangles.size()) + q, mesh_.quads[q]); }

 private:
  class InSpace;
  template <std::size_t N>
  ElementShape shape(Index element, const std::array<Index, N>& nodes) const;

  SurfaceElements mesh_;
  Eigen::Vector3d normal_ = Eigen::Vector3d::UnitZ();  ///< of all, if there is no `in_space_`
  std::unique_ptr<const InSpace> in_space_;
};

}  // namespace qmorph
