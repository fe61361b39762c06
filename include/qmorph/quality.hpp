// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The quality figures: one definition for report, JSON and tests.
///
/// Sources, by the names that the comments below use:
/// [Verdict]  C. Stimpson, C. Ernst, P. Knupp, P. Pebay, D. Thompson: The Verdict Library Reference Manual,
///            SAND2007-2853P. A quad is acceptable from scaled Jacobian 0.3 and angles of 45 to 135 degrees.
/// [Gmsh]     `Mesh.RecombineMinimumQuality` in the Gmsh reference manual; Remacle et al., "Blossom-Quad", IJNME 89
///            (2012), eq. 6.
/// [thesis]   the Q-Morph thesis (src/README.md), eq. 2.2 with the factor 4 of section 3.7; glossary for the valence.

#include <Eigen/Core>
#include <array>
#include <map>
#include <span>
#include <vector>

#include "qmorph/export.hpp"
#include "qmorph/index.hpp"

namespace qmorph {

struct Patch;
struct QuadMesh;
class Shapes;

/// Figures of one mesh, or of several meshes together (see `QualityAccumulator`). The shape figures are those of the
/// quads, where nothing else is said; without a quad they keep the values of a square.
struct Quality {
  std::size_t quads = 0;
  std::size_t triangles = 0;
  std::size_t inverted = 0;  ///< elements, triangles too, with a corner whose Jacobian is not positive
  double scaled_jacobian_min = 1, scaled_jacobian_p1 = 1, scaled_jacobian_p5 = 1, scaled_jacobian_mean = 1;
  double scaled_jacobian_below_03 = 0;  ///< share of quads under 0.3
  double eta_min = 1, eta_mean = 1;
  double thesis_min = 1, thesis_mean = 1;
  double angle_min_deg = 90, angle_max_deg = 90;
  double triangle_metric_min = 1, triangle_metric_mean = 1;  ///< of the triangles; 1 without one
  std::size_t interior_nodes = 0;                            ///< nodes on no edge that has one element only
  std::size_t irregular_nodes = 0;                           ///< interior nodes whose valence is not 4
  std::map<int, std::size_t> valence;                        ///< interior nodes by number of edges
  std::map<int, std::size_t> boundary_valence;               ///< boundary nodes by `boundary_valence()`
  double irregular_share() const { return interior_nodes ? double(irregular_nodes) / double(interior_nodes) : 0.0; }
};

using QuadCorners = std::array<Eigen::Vector3d, 4>;
using TriangleCorners = std::array<Eigen::Vector3d, 3>;

/// Scaled Jacobian of a quad in the plane with unit normal `normal`: the smallest over its corners of the sine of the
/// corner angle, signed [Verdict]. 1 for rectangles, 0 for a corner of 180 degrees or two corners at one place,
/// negative for a reflex corner. -1 where a coordinate is NaN.
QMORPH_API double scaled_jacobian(const QuadCorners& corners, const Eigen::Vector3d& normal);

/// The same for a triangle: the sine of its smallest angle, negative if it is inverted. At most sin 60 degrees.
QMORPH_API double scaled_jacobian(const TriangleCorners& corners, const Eigen::Vector3d& normal);

/// Interior angles in degrees, from 0 to 360, seen against `normal`; 0 where an edge has no length.
QMORPH_API std::array<double, 4> corner_angles_deg(const QuadCorners& corners, const Eigen::Vector3d& normal);

/// max(0, 1 - max |90 - angle| / 90) [Gmsh].
QMORPH_API double eta(const QuadCorners& corners, const Eigen::Vector3d& normal);

/// The smallest metric of the four triangles that the two diagonals make, less 1 if two of them are inverted or a
/// corner is under 6 degrees, less 2 for three, less 3 for four [thesis]. 1 for a square.
QMORPH_API double thesis_metric(const QuadCorners& corners, const Eigen::Vector3d& normal);

/// Metric of a triangle: 1 if its sides are equal, negative if it is inverted [thesis, eq. 2.1].
QMORPH_API double thesis_metric(const TriangleCorners& corners, const Eigen::Vector3d& normal);

/// The valence that stands for a boundary node with `edges` edges and the interior angle `angle_deg`: two more
/// up to 135 degrees, one more up to 225, else as it is [thesis, glossary].
QMORPH_API int boundary_valence(int edges, double angle_deg);

/// Collects surfaces, then gives the figures of all of them together. The cost is linear in the number of elements;
/// sums run in the order of the elements, so the figures are the same on every run.
class QMORPH_API QualityAccumulator {
 public:
  /// Adds a surface. `normal` is the unit normal that its elements follow.
  void add(std::span<const Eigen::Vector3d> points, std::span<const std::array<Index, 3>> triangles,
           std::span<const std::array<Index, 4>> quads, const Eigen::Vector3d& normal);

  /// Adds a surface whose normal is not known: the mean normal if all elements lie in its plane, else (a curved
  /// surface) each element is judged by the normals of those around it.
  void add(std::span<const Eigen::Vector3d> points, std::span<const std::array<Index, 3>> triangles,
           std::span<const std::array<Index, 4>> quads);

  /// Adds what a surface was made into. On a curved surface a corner is turned over if it is against the normals of the
  /// input's triangles near it, and of the whole element's, and the scaled Jacobian is the least of the corner sines in
  /// space. Where quads of the input are bad themselves, the normals are those of the elements around.
  void add(const Patch& before, const QuadMesh& after);

  /// Adds the surfaces that another one has collected.
  void add(const QualityAccumulator& other);

  Quality result() const;
  /// Of each quad, in the order in which they were added.
  std::span<const double> scaled_jacobians() const { return scaled_jacobians_; }

 private:
  friend class Judged;
  void add_elements(std::span<const Eigen::Vector3d> points, std::span<const std::array<Index, 3>> triangles,
                    std::span<const std::array<Index, 4>> quads, const Shapes& shapes);

  Quality counts_;
  std::vector<double> scaled_jacobians_;
  double eta_sum_ = 0, thesis_sum_ = 0, triangle_sum_ = 0;
};

/// Figures of one surface.
QMORPH_API Quality measure(const QuadMesh& mesh, const Eigen::Vector3d& normal);
QMORPH_API Quality measure(const QuadMesh& mesh);  ///< the normal as `QualityAccumulator::add` finds it

}  // namespace qmorph
