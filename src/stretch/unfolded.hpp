// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A stretched surface in a plane, laid out again so that its triangles are about as long as wide, and the way back.

#include <optional>
#include <vector>

#include "chart/chart.hpp"
#include "stretch/metric_field.hpp"

namespace qmorph::stretch {

/// Triangles of a plane as a surface in space.
struct Surface {
  std::vector<Eigen::Vector3d> points;
  std::vector<space::Background::Triangle> triangles;
  std::vector<space::Background::Edge> barriers;
  space::Background background;

  Surface(const std::vector<Vec2>& points, std::vector<space::Background::Triangle> triangles,
          std::vector<space::Background::Edge> barriers);
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;
};

/// By lengths of the metric; nothing if that is not possible. If the metric is the same everywhere, it is a linear map.
std::optional<chart::Flattening> unfold(const space::Background& surface, const MetricField& field);

class Unfolded {
 public:
  /// Both must outlive it.
  Unfolded(const Surface& surface, const MetricField& field, chart::Flattening flattening)
      : surface_(surface),
        field_(field),
        chart_(surface.points, surface.triangles, surface.barriers, std::move(flattening)) {}

  const std::vector<Vec2>& flat() const { return chart_.flat(); }
  /// The point of the surface's plane that is at p in the chart. Cost: linear.
  Vec2 in_plane(const Vec2& p) const { return in_plane(chart_.nearest_of_all(p)); }
  /// Moves a mesh from the chart to the plane.
  void lift(kernel::Mesh& mesh) const { lift(mesh, chart_.places(mesh)); }
  /// The same, and nodes go where quads have good shapes in the plane; straighten().
  void lift_and_straighten(kernel::Mesh& mesh) const;

 private:
  using Place = chart::Chart::Place;

  Vec2 in_plane(const Place& place) const { return chart_.to_space(place).head<2>(); }
  void lift(kernel::Mesh& mesh, const std::vector<Place>& places) const;

  const Surface& surface_;
  const MetricField& field_;
  const chart::Chart chart_;
};

/// What is straight by the metric is straight; what is right by the metric may be as thin in the plane as triangles
/// are.
bool is_valid(const kernel::Mesh& mesh, const MetricField& field);

}  // namespace qmorph::stretch
