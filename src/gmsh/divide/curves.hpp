// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The curves of a geometry as Gmsh divides them.

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "qmorph/index.hpp"

namespace qmorph::adapter {

/// A curve with nodes four times as dense as wished: where they are tells the sizes along the curve.
struct DividedCurve {
  int tag = 0;
  int segments = 0;                     ///< as Gmsh divides it; 0 if it has no mesh
  int finer = 0;                        ///< the same for a quarter of the size
  std::array<int, 2> ends{};            ///< points, tags; of a closed curve twice the same
  std::vector<double> parameters;       ///< of the finer nodes, with the ends
  std::vector<Eigen::Vector3d> points;  ///< of the same
  double length = 0;
  bool carried = false;        ///< by an extrusion, or it carries another
  std::vector<double> tips{};  ///< where the first segment from a tip ends, in segments of the finer nodes (tips.hpp)
  bool is_spare = false;  ///< half of its two segments: a straight piece of a spline, of which Gmsh makes two at least

  double wish() const;  ///< its length in sizes
  double size() const { return segments > 0 ? length / segments : length; }
  double parameter_at(double at) const;  ///< `at` counts the segments between the finer nodes
  bool depends_on_size() const { return segments > 0 && (finer > segments || is_spare); }
};

struct BoundedSurface {
  int tag = 0;
  std::vector<Index> boundary;  ///< curves; one that has the surface on both sides twice
  std::vector<Index> embedded;
};

/// What Gmsh's division of the curves is for.
struct CurveModel {
  std::vector<DividedCurve> curves;  ///< by tag; pieces of one (cuts.hpp) follow one another
  std::vector<BoundedSurface> surfaces;
  std::vector<std::pair<Index, Index>> images;  ///< periodic, or carried along by an extrusion

  Index find(int tag) const;  ///< kNone if there is none
};

/// Parameters that cut a curve into so many segments, each as long as the sizes along it say; without its ends.
std::vector<double> parameters_for(const DividedCurve& curve, int segments);
std::vector<Eigen::Vector3d> points_at(const DividedCurve& curve, const std::vector<double>& parameters);

/// How many line elements a curve has.
int count_segments(int curve);

/// Nodes inside a curve by their parameters.
std::vector<std::pair<double, std::size_t>> nodes_along(int curve);

/// Has Gmsh divide all curves, twice, the second time as wished. For the surfaces with these tags.
/// Nothing if one of their curves cannot be understood.
std::optional<CurveModel> divide_as_wished(const std::vector<int>& surfaces);

}  // namespace qmorph::adapter
