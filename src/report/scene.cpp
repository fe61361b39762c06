#include "report/scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "qmorph/quality.hpp"
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
      measure_shapes(surface);
      measure_nodes(surface);
    }
    return std::move(figures_);
  }

 private:
  void measure_shapes(const SceneEntity& surface) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double length = 0;
    for (std::size_t f = surface.first; f < surface.first + surface.count; ++f) {
      const Eigen::Vector3d area = area_vector(scene_, f);
      sum += area, length += area.norm();
    }
    const bool planar = sum.norm() > kPlanarShare * length;
    for (std::size_t f = surface.first; f < surface.first + surface.count; ++f)
      measure_face(f, (planar ? sum : area_vector(scene_, f)).stableNormalized());
  }

  void measure_face(std::size_t f, const Eigen::Vector3d& normal) {
    const auto& n = scene_.faces[f];
    const Index corners = corners_of(n);
    double length = 0;
    for (Index i = 0; i < corners; ++i) length += (scene_.points[n[(i + 1) % corners]] - scene_.points[n[i]]).norm();
    figures_.size[f] = float(length / corners);
    if (corners == 3) {
      const TriangleCorners t{scene_.points[n[0]], scene_.points[n[1]], scene_.points[n[2]]};
      figures_.scaled_jacobian[f] = float(scaled_jacobian(t, normal));
      figures_.thesis_metric[f] = float(thesis_metric(t, normal));
      figures_.eta[f] = std::numeric_limits<float>::quiet_NaN();
      return;
    }
    const QuadCorners q{scene_.points[n[0]], scene_.points[n[1]], scene_.points[n[2]], scene_.points[n[3]]};
    figures_.scaled_jacobian[f] = float(scaled_jacobian(q, normal));
    figures_.thesis_metric[f] = float(thesis_metric(q, normal));
    figures_.eta[f] = float(eta(q, normal));
  }

  /// Valences and boundary, in a numbering of the surface's own: the cost of many small surfaces stays linear.
  void measure_nodes(const SceneEntity& surface) {
    std::vector<Index> nodes;
    std::vector<std::array<Index, 3>> triangles;
    std::vector<std::array<Index, 4>> quads;
    std::vector<std::pair<Index, Index>> sides;
    for (std::size_t f = surface.first; f < surface.first + surface.count; ++f) {
      std::array<Index, 4> own{};
      const Index corners = corners_of(scene_.faces[f]);
      for (Index i = 0; i < corners; ++i) {
        const Index node = scene_.faces[f][i];
        if (local_[node] == kNone) local_[node] = Index(nodes.size()), nodes.push_back(node);
        own[i] = local_[node];
        sides.push_back(std::minmax(node, scene_.faces[f][(i + 1) % corners]));
      }
      if (corners == 3)
        triangles.push_back({own[0], own[1], own[2]});
      else
        quads.push_back(own);
    }
    if (!quads.empty()) {
      const NodeDegrees degrees = node_degrees(nodes.size(), triangles, quads);
      for (Index i = 0; i < nodes.size(); ++i)
        if (!degrees.boundary[i] && degrees.edges[i] != 4) figures_.irregular.push_back({nodes[i], degrees.edges[i]});
    }
    note_open_edges(std::move(sides));
    for (Index node : nodes) local_[node] = kNone;
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
    const Eigen::Vector3d axis = std::abs(normal.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
    frame.right = (axis - axis.dot(normal) * normal).normalized();
    frame.up = normal.cross(frame.right);
  }
  for (const auto& face : scene.faces)
    for (Index i = 0; i < corners_of(face); ++i)
      if (std::abs(frame.to_frame(scene.points[face[i]]).z()) > kFlat * frame.radius) frame.flat = false;
  if (!frame.flat) frame.right = Eigen::Vector3d::UnitX(), frame.up = Eigen::Vector3d::UnitZ();
  return frame;
}

}  // namespace qmorph::report
