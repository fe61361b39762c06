// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/convert/pillow_bent.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gmsh/model/high_order.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "space/pillow.hpp"
#include "space/result.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector3d;

/// Where the sides of a surface's elements set out, once they are curved.
class Directions {
 public:
  virtual ~Directions() = default;
  /// Of side k of the quad at that of its ends which is corner `at` (k or the next): away from there.
  virtual Vector3d at(Index quad, std::size_t k, std::size_t at) const = 0;
};

/// By the middle nodes of the input.
class OfElements : public Directions {
 public:
  OfElements(const CurvedElements& elements, std::size_t triangles) : elements_(elements), triangles_(triangles) {}

  Vector3d at(Index quad, std::size_t k, std::size_t at) const override {
    const Index e = Index(triangles_) + quad;
    const auto& corners = elements_.element(e).corners;
    std::vector<Vector3d> line{elements_.points()[corners[k]]};
    for (const MiddleNode& node : elements_.along(e, k)) line.push_back(node.place);
    line.push_back(elements_.points()[corners[(k + 1) % 4]]);
    if (at != k) std::reverse(line.begin(), line.end());
    // The derivative at 0 of the polynomial through points at equal steps.
    const auto order = static_cast<double>(line.size() - 1);
    Vector3d direction = Vector3d::Zero();
    double binomial = 1;
    for (std::size_t j = 1; j < line.size(); ++j) {
      const auto step = static_cast<double>(j);
      binomial *= (order - step + 1) / step;
      direction += (j % 2 == 1 ? 1 : -1) * binomial * order / step * (line[j] - line[0]);
    }
    return direction;
  }

 private:
  const CurvedElements& elements_;
  const std::size_t triangles_;
};

/// By the curves of the geometry, whose middle nodes are not there yet.
class OfCurves : public Directions {
 public:
  OfCurves(const ModelMesh& mesh, int surface, const SurfacePart& part, const QuadMesh& result, int order)
      : mesh_(mesh), part_(part), result_(result), order_(order) {
    std::vector<int> volumes, curves;
    ::gmsh::model::getAdjacencies(2, surface, volumes, curves);
    for (const int curve : curves) {
      const EntityMesh* entity = find_entity(mesh, 1, curve);
      const std::string type = entity_type(1, curve);
      if (!entity || type == "Line" || type.find("Discrete") != std::string::npos) continue;
      for (const ElementBlock& block : entity->blocks)
        for (std::size_t i = 0; i + 1 < block.nodes.size(); i += block.nodes_per_element)
          curve_.emplace(edge(mesh.rows.find(block.nodes[i]), mesh.rows.find(block.nodes[i + 1])), curve);
    }
  }

  Vector3d at(Index quad, std::size_t k, std::size_t at) const override {
    const Index from = row(quad, at), to = row(quad, at == k ? (k + 1) % 4 : k);
    const Vector3d chord = mesh_.points[to] - mesh_.points[from];
    const auto curve = curve_.find(edge(from, to));
    if (curve == curve_.end()) return chord;
    const Vector3d tangent = tangent_of(curve->second, mesh_.points[from]);
    const Vector3d along = (tangent.dot(chord) < 0 ? -1 : 1) * tangent;
    if (order_ > 2 || !(tangent.norm() > 0)) return tangent.norm() > 0 ? along : chord;
    // The parabola through the middle of the arc between the ends.
    const Vector3d beside = along - along.dot(chord) / chord.squaredNorm() * chord;
    const double half = 0.5 * std::atan2(along.cross(chord).norm(), along.dot(chord));
    return chord + 2 * chord.norm() * std::tan(half) * beside.stableNormalized();
  }

 private:
  using Edge = std::array<Index, 2>;
  static Edge edge(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }
  Index row(Index quad, std::size_t corner) const {
    return part_.rows[result_.source[result_.quads[quad][corner % 4]]];
  }
  /// Unit, or zero where Gmsh does not know.
  static Vector3d tangent_of(int curve, const Vector3d& point) {
    Vector3d tangent = Vector3d::Zero();
    run_logged([&] {
      std::vector<double> parameter, derivative;
      ::gmsh::model::getParametrization(1, curve, {point.x(), point.y(), point.z()}, parameter);
      ::gmsh::model::getDerivative(1, curve, parameter, derivative);
      if (derivative.size() == 3) tangent = Vector3d(derivative.data()).stableNormalized();
    });
    return tangent.allFinite() ? tangent : Vector3d::Zero();
  }

  const ModelMesh& mesh_;
  const SurfacePart& part_;
  const QuadMesh& result_;
  const int order_;
  std::map<Edge, int> curve_;  ///< by rows of the model
};

/// Corners between two sides that are the input's.
std::vector<std::pair<Index, std::size_t>> corners_alone(const space::Result& result, std::size_t kept) {
  const QuadMesh& mesh = result.mesh();
  std::vector<std::pair<Index, std::size_t>> corners;
  for (Index q = Index(kept); q < mesh.quads.size(); ++q)
    for (std::size_t k = 0; k < 4; ++k) {
      const Index side = 4 * Index(mesh.triangles.size() + q) + Index(k), behind = result.sides().previous(side);
      if (result.sides().opposite(side) == kNone && result.sides().opposite(behind) == kNone)
        corners.emplace_back(q, k);
    }
  return corners;
}

/// Curving makes it much flatter, and poor.
bool is_bent(const QuadMesh& mesh, const Directions& directions, Index quad, std::size_t k) {
  constexpr double kPoor = 0.1, kMuch = 0.5;  // sine, and part of what it was
  const auto point = [&](std::size_t i) -> const Vector3d& { return mesh.points[mesh.quads[quad][i % 4]]; };
  const Vector3d ahead = point(k + 1) - point(k), behind = point(k + 3) - point(k), up = ahead.cross(behind);
  const double straight = up.norm() / (ahead.norm() * behind.norm());
  const Vector3d to = directions.at(quad, k, k), from = directions.at(quad, (k + 3) % 4, k);
  const double curved = to.cross(from).dot(up.normalized()) / (to.norm() * from.norm());
  return curved < std::min(kPoor, kMuch * straight);
}

int order_to_come() { return static_cast<int>(get_option("Mesh.ElementOrder")); }

std::vector<Index> bent_quads(const ModelMesh& mesh, const EntityMesh& before, const SurfacePart& part,
                              const space::Result& result, std::size_t kept) {
  const auto corners = corners_alone(result, kept);
  const int order = order_of(before);
  if (corners.empty()) return {};
  std::optional<CurvedElements> elements;
  if (order > 1) elements = curve_result(mesh, before, part, result.mesh());
  std::vector<Index> bent;
  const auto take = [&](const Directions& directions) {
    for (const auto& corner : corners)
      if ((bent.empty() || bent.back() != corner.first) &&
          is_bent(result.mesh(), directions, corner.first, corner.second))
        bent.push_back(corner.first);
  };
  if (elements)
    take(OfElements(*elements, result.mesh().triangles.size()));
  else
    take(OfCurves(mesh, before.tag, part, result.mesh(), order_to_come()));
  return bent;
}

/// How many elements of it are folded, whatever is done about it. None if it is linear.
std::size_t folded(const ModelMesh& mesh, const EntityMesh& before, const SurfacePart& part, const QuadMesh& result) {
  if (order_of(before) == 1) return 0;
  CurvedElements elements = curve_result(mesh, before, part, result);
  elements.unfold();
  std::size_t count = 0;
  for (Index e = 0; e < elements.elements(); ++e) count += !elements.element(e).is_kept && elements.is_folded(e);
  return count;
}

/// The quads that share a node with these, and these.
std::vector<Index> with_neighbours(const QuadMesh& mesh, const std::vector<Index>& quads, std::size_t kept) {
  std::vector<char> is_near(mesh.points.size(), 0);
  for (const Index q : quads)
    for (const Index v : mesh.quads[q]) is_near[v] = 1;
  std::vector<Index> near;
  for (Index q = Index(kept); q < mesh.quads.size(); ++q)
    if (std::any_of(mesh.quads[q].begin(), mesh.quads[q].end(), [&](Index v) { return is_near[v]; })) near.push_back(q);
  return near;
}

/// Smallest scaled Jacobian of a quad.
double least_sine(const SurfacePart& part, const QuadMesh& mesh) {
  const space::Result result(part.patch, mesh);
  double least = 1;
  for (Index q = 0; q < mesh.quads.size(); ++q) {
    space::Corners<4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.points[mesh.quads[q][k]];
    const auto sines = result.sines(Index(mesh.triangles.size()) + q, p, mesh.quads[q]);
    least = std::min(least, *std::min_element(sines.begin(), sines.end()));
  }
  return least;
}

/// Around the bent quads alone, or a ring that takes in those around as well, if that is better: a row along a whole
/// circle is.
QuadMesh best_pillow(const SurfacePart& part, const space::Result& result, const std::vector<Index>& bent,
                     std::size_t kept) {
  QuadMesh best = space::pillow(part.patch, result, bent);
  const std::vector<Index> more = with_neighbours(result.mesh(), bent, kept);
  QuadMesh other = space::pillow(part.patch, result, more);
  return least_sine(part, other) > least_sine(part, best) ? other : best;
}

}  // namespace

void pillow_bent_quads(const ModelMesh& mesh, ConvertedSurface& surface) {
  const EntityMesh& before = mesh.entities[surface.surface.entity];
  if (order_of(before) == 1 && order_to_come() == 1) return;
  for (std::size_t p = 0; p < surface.results.size(); ++p) {
    const SurfacePart& part = surface.surface.parts[p];
    const std::size_t kept = surface.surface.quads_may_go ? 0 : part.patch.quads.size();
    const space::Result result(part.patch, surface.results[p]);
    const std::vector<Index> bent = bent_quads(mesh, before, part, result, kept);
    if (bent.empty()) continue;
    QuadMesh pillowed = best_pillow(part, result, bent, kept);
    const std::size_t were = folded(mesh, before, part, surface.results[p]);
    const std::size_t are = folded(mesh, before, part, pillowed);
    if (are < were || were == 0) surface.results[p] = std::move(pillowed);
  }
}

}  // namespace qmorph::adapter
