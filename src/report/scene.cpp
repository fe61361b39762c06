// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "quality/shapes.hpp"
#include "quality/valence.hpp"

namespace qmorph::report {
namespace {

/// A surface is planar for the figures if its elements' area vectors add up to this share of their lengths.
constexpr double kPlanarShare = 0.999;
/// A scene is flat if no point is farther from the plane than this times its radius.
constexpr double kFlat = 1e-6;
/// A normal nearer to the z axis than this (cosine) is taken for it.
constexpr double kAlongZ = 0.999;

Eigen::Vector3d area_vector(const Scene& scene, std::size_t f) {
  const auto& n = scene.faces[f];
  const Eigen::Vector3d &a = scene.points[n[0]], &b = scene.points[n[1]], &c = scene.points[n[2]];
  const Eigen::Vector3d& d = n[3] == kNone ? c : scene.points[n[3]];
  return 0.5 * (c - a).cross(n[3] == kNone ? Eigen::Vector3d(c - b) : Eigen::Vector3d(d - b));
}

class Measurement {
 public:
  explicit Measurement(const Scene& scene) : scene_(scene), local_(scene.points.size(), kNone) {
    for (auto* column : {&figures_.scaled_jacobian, &figures_.eta, &figures_.thesis_metric, &figures_.size})
      column->resize(scene.faces.size());
    for (const auto& line : scene.lines) lines_.push_back(std::minmax(line[0], line[1]));
    std::sort(lines_.begin(), lines_.end());
  }

  SceneFigures run() {
    for (const SceneEntity& surface : scene_.surfaces) {
      const Local local = localise(surface);
      measure_shapes(surface, local);
      measure_nodes(local);
    }
    return std::move(figures_);
  }

 private:
  /// A surface in a numbering of its own: the cost of many small surfaces stays linear.
  struct Local {
    std::vector<Index> nodes;
    std::vector<Eigen::Vector3d> points;
    std::vector<std::array<Index, 3>> triangles;
    std::vector<std::array<Index, 4>> quads;
    std::vector<std::pair<Index, Index>> sides;  ///< in the scene's numbering
  };

  Local localise(const SceneEntity& surface) {
    Local local;
    for (std::size_t f = surface.first; f < surface.first + surface.count; ++f) {
      std::array<Index, 4> own{};
      const Index corners = corners_of(scene_.faces[f]);
      for (Index i = 0; i < corners; ++i) {
        const Index node = scene_.faces[f][i];
        if (local_[node] == kNone) {
          local_[node] = Index(local.nodes.size());
          local.nodes.push_back(node);
          local.points.push_back(scene_.points[node]);
        }
        own[i] = local_[node];
        local.sides.push_back(std::minmax(node, scene_.faces[f][(i + 1) % corners]));
      }
      if (corners == 3)
        local.triangles.push_back({own[0], own[1], own[2]});
      else
        local.quads.push_back(own);
    }
    for (Index node : local.nodes) local_[node] = kNone;
    return local;
  }

  void measure_shapes(const SceneEntity& surface, const Local& local) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double length = 0;
    for (std::size_t f = surface.first; f < surface.first + surface.count; ++f) {
      const Eigen::Vector3d area = area_vector(scene_, f);
      sum += area, length += area.norm();
      measure_size(f);
    }
    const bool planar = sum.norm() > kPlanarShare * length;
    const SurfaceElements elements{local.points, local.triangles, local.quads};
    const Shapes shapes = planar ? Shapes(elements, sum.stableNormalized()) : Shapes(elements);
    Index triangle = 0, quad = 0;
    for (std::size_t f = surface.first; f < surface.first + surface.count; ++f) {
      const bool is_quad = corners_of(scene_.faces[f]) == 4;
      const ElementShape shape = is_quad ? shapes.quad(quad++) : shapes.triangle(triangle++);
      figures_.scaled_jacobian[f] = float(shape.scaled_jacobian);
      figures_.thesis_metric[f] = float(shape.thesis_metric);
      figures_.eta[f] = is_quad ? float(shape.eta) : std::numeric_limits<float>::quiet_NaN();
    }
  }

  void measure_size(std::size_t f) {
    const auto& n = scene_.faces[f];
    const Index corners = corners_of(n);
    double length = 0;
    for (Index i = 0; i < corners; ++i) length += (scene_.points[n[(i + 1) % corners]] - scene_.points[n[i]]).norm();
    figures_.size[f] = float(length / corners);
  }

  void measure_nodes(const Local& local) {
    if (!local.quads.empty()) {
      const NodeDegrees degrees = node_degrees(local.nodes.size(), local.triangles, local.quads);
      for (Index i = 0; i < local.nodes.size(); ++i)
        if (!degrees.boundary[i] && degrees.edges[i] != 4)
          figures_.irregular.push_back({local.nodes[i], degrees.edges[i]});
    }
    note_open_edges(local.sides);
  }

  void note_open_edges(std::vector<std::pair<Index, Index>> sides) {
    std::sort(sides.begin(), sides.end());
    for (std::size_t i = 0, end; i < sides.size(); i = end) {
      for (end = i; end < sides.size() && sides[end] == sides[i];) ++end;
      if (end - i == 1 && !std::binary_search(lines_.begin(), lines_.end(), sides[i]))
        figures_.open_edges.push_back({sides[i].first, sides[i].second});
    }
  }

  const Scene& scene_;
  SceneFigures figures_;
  std::vector<Index> local_;
  std::vector<std::pair<Index, Index>> lines_;
};

/// A box's corners, by its axes.
struct Box {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  void add(const Eigen::Vector3d& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
};

}  // namespace

SceneFigures measure(const Scene& scene) { return Measurement(scene).run(); }

Eigen::Vector3d Frame::normal() const { return right.cross(up); }

Eigen::Vector3d Frame::to_frame(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d d = p - centre;
  return {d.dot(right), d.dot(up), d.dot(normal())};
}

Eigen::Vector3d right_of(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d axis = std::abs(normal.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  return (axis - axis.dot(normal) * normal).normalized();
}

Frame find_frame(const Scene& scene) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Box box;
  for (const SceneEntity& surface : scene.surfaces) {
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    for (std::size_t f = surface.first; f < surface.first + surface.count; ++f) area += area_vector(scene, f);
    normal += area.dot(normal) >= 0 ? area : Eigen::Vector3d(-area);  // no surface outweighs another by its sign
  }
  for (const auto& face : scene.faces)
    for (Index i = 0; i < corners_of(face); ++i) box.add(scene.points[face[i]]);
  Frame frame;
  if (scene.faces.empty()) return frame;
  frame.centre = 0.5 * (box.low + box.high);
  frame.radius = std::max(0.5 * (box.high - box.low).norm(), std::numeric_limits<double>::min());
  normal = normal.norm() > 0 ? Eigen::Vector3d(normal.stableNormalized()) : Eigen::Vector3d::UnitZ();
  Index largest = 0;
  normal.cwiseAbs().maxCoeff(&largest);
  if (normal[largest] < 0) normal = -normal;
  if (normal.z() < kAlongZ) {
    frame.right = right_of(normal);
    frame.up = normal.cross(frame.right);
  }
  for (const auto& face : scene.faces)
    for (Index i = 0; i < corners_of(face); ++i)
      if (std::abs(frame.to_frame(scene.points[face[i]]).z()) > kFlat * frame.radius) frame.flat = false;
  if (!frame.flat) frame.right = Eigen::Vector3d::UnitX(), frame.up = Eigen::Vector3d::UnitZ();
  return frame;
}

}  // namespace qmorph::report
