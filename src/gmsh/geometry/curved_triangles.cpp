// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/geometry/curved_triangles.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "gmsh/session/compat.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

/// What Gmsh calls `name` of an element type at points of the reference element: a row for each point.
std::vector<double> at_points(const char* name, int type, const std::vector<Vector2d>& points) {
  std::vector<double> uvw, values;
  for (const Vector2d& p : points) uvw.insert(uvw.end(), {p.x(), p.y(), 0});
  int components = 0, orientations = 0;
  if (!points.empty()) ::gmsh::model::mesh::getBasisFunctions(type, uvw, name, components, values, orientations);
  return values;
}

std::vector<double> functions_at(int type, const std::vector<Vector2d>& points) {
  return at_points("Lagrange", type, points);
}

/// By u, v and w, three for each function.
std::vector<double> slopes_at(int type, const std::vector<Vector2d>& points) {
  return at_points("GradLagrange", type, points);
}

/// The nearest point of the reference element, or one near that.
Vector2d inside(const ElementType& type, const Vector2d& p) {
  if (type.corners == 4) return p.cwiseMax(-1.0).cwiseMin(1.0);
  const Vector2d positive = p.cwiseMax(0.0);
  return positive / std::max(1.0, positive.sum());
}

Vector2d local_point(const ElementType& type, std::size_t node) {
  return {type.local[2 * node], type.local[2 * node + 1]};
}

}  // namespace

std::unique_ptr<CurvedTriangles> CurvedTriangles::find(const ModelMesh& mesh, std::uint32_t entity) {
  const EntityMesh& surface = mesh.entities[entity];
  if (std::none_of(surface.blocks.begin(), surface.blocks.end(), [](const ElementBlock& b) { return b.order > 1; }))
    return nullptr;
  std::unique_ptr<CurvedTriangles> curved(new CurvedTriangles(mesh, surface));
  return curved->are_flat() ? nullptr : std::move(curved);
}

CurvedTriangles::CurvedTriangles(const ModelMesh& mesh, const EntityMesh& surface) : mesh_(mesh), surface_(surface) {
  for (std::size_t b = 0; b < surface.blocks.size(); ++b) {
    const ElementBlock& block = surface.blocks[b];
    types_.push_back(element_type(block.type));
    for (std::size_t e = 0; e < block.tags.size(); ++e)
      for (std::size_t left_out = block.corners == 4 ? 0 : 3; left_out < 4; ++left_out) {
        std::array<std::size_t, 3> corners{};
        for (std::size_t k = 0, i = 0; i < 3; ++k)
          if (k != left_out) corners[i++] = k;
        const auto row = [&](std::size_t k) { return mesh.rows.find(block.nodes[e * block.nodes_per_element + k]); };
        std::sort(corners.begin(), corners.end(), [&](std::size_t i, std::size_t j) { return row(i) < row(j); });
        places_.try_emplace({row(corners[0]), row(corners[1]), row(corners[2])}, Place{b, e, corners});
        if (block.corners == 3) break;
      }
  }
}

bool CurvedTriangles::are_flat() const {
  constexpr double kFlat = 1e-6;  // of the element's size: between a node and the linear element
  for (std::size_t b = 0; b < surface_.blocks.size(); ++b) {
    const ElementBlock& block = surface_.blocks[b];
    std::vector<Vector2d> local;
    for (std::size_t i = 0; i < types_[b].nodes; ++i) local.push_back(local_point(types_[b], i));
    const std::vector<double> linear = functions_at(type_number(block.corners, 1, false), local);
    for (std::size_t e = 0; e < block.tags.size(); ++e) {
      const Vector3d along = node(block, e, 2) - node(block, e, 0);
      const Vector3d up = (node(block, e, 1) - node(block, e, block.corners - 1)).cross(along).normalized();
      for (std::size_t i = block.corners; i < types_[b].nodes; ++i) {
        Vector3d off = node(block, e, i);
        for (std::size_t k = 0; k < block.corners; ++k) off -= linear[i * block.corners + k] * node(block, e, k);
        if (std::abs(off.dot(up)) > kFlat * along.norm()) return false;
      }
    }
  }
  return true;
}

Vector3d CurvedTriangles::at(std::size_t b, std::size_t element, const double* functions) const {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < types_[b].nodes; ++k) sum += functions[k] * node(surface_.blocks[b], element, k);
  return sum;
}

/// Steps of Newton's method for the closest point, without second derivatives. Gmsh puts nodes of curved sides evenly
/// in the parameters of the geometry, not along the side: where the weights of a point are in the curved element may be
/// far beside the point, and elements of order 3 fold by that.
void CurvedTriangles::come_nearest(std::size_t b, std::span<const OnInput> points, const std::vector<Asked>& asked,
                                   std::vector<Vector2d>& local) const {
  constexpr int kSteps = 3;
  const std::size_t count = types_[b].nodes;
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<double> functions = functions_at(types_[b].type, local),
                              slopes = slopes_at(types_[b].type, local);
    for (std::size_t j = 0; j < asked.size(); ++j) {
      Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
      for (std::size_t k = 0; k < count; ++k) {
        const double* slope = slopes.data() + 3 * (j * count + k);
        tangents += node(surface_.blocks[b], asked[j].element, k) * Eigen::RowVector2d(slope[0], slope[1]);
      }
      const Vector3d off = points[asked[j].point].point - at(b, asked[j].element, functions.data() + j * count);
      const Eigen::Matrix2d squares = tangents.transpose() * tangents;
      const Vector2d way = squares.inverse() * (tangents.transpose() * off);
      if (way.allFinite()) local[j] = inside(types_[b], local[j] + way);
    }
  }
}

std::vector<Landing> CurvedTriangles::land(std::span<const OnInput> points) const {
  std::vector<Landing> landings(points.size());
  std::vector<std::vector<Vector2d>> local(types_.size());  // by block
  std::vector<std::vector<Asked>> asked(types_.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    landings[i].point = points[i].point;
    std::array<std::size_t, 3> order = {0, 1, 2};
    std::sort(order.begin(), order.end(),
              [&](std::size_t j, std::size_t k) { return points[i].corners[j] < points[i].corners[k]; });
    const auto& rows = points[i].corners;
    const auto found = places_.find({rows[order[0]], rows[order[1]], rows[order[2]]});
    if (found == places_.end()) continue;
    const Place& place = found->second;
    Vector2d at = Vector2d::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      at += points[i].weights[Eigen::Index(order[k])] * local_point(types_[place.block], place.corners[k]);
    local[place.block].push_back(at);
    asked[place.block].push_back({i, place.element});
  }
  for (std::size_t b = 0; b < types_.size(); ++b) {
    come_nearest(b, points, asked[b], local[b]);
    const std::vector<double> functions = functions_at(types_[b].type, local[b]);
    for (std::size_t j = 0; j < asked[b].size(); ++j) {
      Landing& landing = landings[asked[b][j].point];
      landing.point = at(b, asked[b][j].element, functions.data() + j * types_[b].nodes);
      landing.found = true;
    }
  }
  return landings;
}

}  // namespace qmorph::adapter
