// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/views/element_locator.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace qmorph::adapter {
namespace {

using Eigen::Vector3d;

/// A point this far outside of an element, relative to a cube of the grid, is in it.
constexpr double kNear = 1e-6;

/// The share of the way inwards at which a point on a border is looked for.
constexpr double kInwards = 1e-3;

/// Barycentric coordinates of a point above or below a triangle.
Vector3d weights_in(const std::array<Vector3d, 3>& p, const Vector3d& at) {
  const Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
  const double square = normal.squaredNorm();
  const double second = normal.dot((at - p[0]).cross(p[2] - p[0])) / square;
  const double third = normal.dot((p[1] - p[0]).cross(at - p[0])) / square;
  return {1 - second - third, second, third};
}

/// At most a few times too long where the point is beside the triangle.
double distance_to(const std::array<Vector3d, 3>& p, const Vector3d& at) {
  Vector3d inside = weights_in(p, at).cwiseMax(0);
  inside /= inside.sum();
  return (inside[0] * p[0] + inside[1] * p[1] + inside[2] * p[2] - at).norm();
}

}  // namespace

struct ElementLocator::Nearest {
  Vector3d point;
  const Piece* piece;
  double distance = std::numeric_limits<double>::infinity();

  void try_one(const Piece& candidate) {
    const double d = distance_to(candidate.points, point);
    if (d >= distance) return;
    distance = d;
    piece = &candidate;
  }
};

std::size_t ElementLocator::CellHash::operator()(const Cell& cell) const {
  std::uint64_t hash = 0;
  for (std::int64_t index : cell) hash = (hash ^ static_cast<std::uint64_t>(index)) * 0x9e3779b97f4a7c15u;
  return static_cast<std::size_t>(hash ^ (hash >> 32));
}

ElementLocator::ElementLocator(const ModelMesh& mesh, const EntityMesh& surface) {
  for (const ElementBlock& block : surface.blocks) {
    if (block.corners != 3 && block.corners != 4) continue;
    for (std::size_t e = 0; e < block.tags.size(); ++e)
      for (std::size_t k = 2; k < block.corners; ++k) add(mesh, block, e, {0, k - 1, k});
  }
  make_grid();
}

void ElementLocator::add(const ModelMesh& mesh, const ElementBlock& block, std::size_t element,
                         std::array<std::size_t, 3> corners) {
  Piece piece{{&block, element, corners, Vector3d::Zero()}, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const Index row = mesh.rows.find(block.nodes[element * block.nodes_per_element + corners[k]]);
    if (row == kNone) return;
    piece.points[k] = mesh.points[row];
  }
  const double square = (piece.points[1] - piece.points[0]).cross(piece.points[2] - piece.points[0]).squaredNorm();
  if (square > 0 && std::isfinite(square)) pieces_.push_back(piece);
}

/// Cubes as long as the elements' mean extent, so that there are a few elements in each; and not many more than there
/// are elements in any direction, whatever their sizes.
void ElementLocator::make_grid() {
  if (pieces_.empty()) return;
  low_ = pieces_.front().points[0];
  Vector3d high = low_;
  double extent = 0;
  for (const Piece& piece : pieces_) {
    for (const Vector3d& p : piece.points) {
      low_ = low_.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    extent += (piece.points[1] - piece.points[0]).norm();
  }
  const double count = static_cast<double>(pieces_.size());
  step_ = std::max(extent / count, (high - low_).maxCoeff() / std::sqrt(count));
  for (Index i = 0; i < pieces_.size(); ++i) {
    const auto& p = pieces_[i].points;
    const Cell from = cell_of(p[0].cwiseMin(p[1]).cwiseMin(p[2])), to = cell_of(p[0].cwiseMax(p[1]).cwiseMax(p[2]));
    for (std::int64_t z = from[2]; z <= to[2]; ++z)
      for (std::int64_t y = from[1]; y <= to[1]; ++y)
        for (std::int64_t x = from[0]; x <= to[0]; ++x) cells_[{x, y, z}].push_back(i);
  }
}

ElementLocator::Cell ElementLocator::cell_of(const Vector3d& point) const {
  constexpr double kFar = 1e15;  // still an integer
  Cell cell{};
  for (int axis = 0; axis < 3; ++axis)
    cell[static_cast<std::size_t>(axis)] =
        static_cast<std::int64_t>(std::clamp(std::floor((point[axis] - low_[axis]) / step_), -kFar, kFar));
  return cell;
}

void ElementLocator::look_into(const Cell& cell, Nearest& nearest) const {
  if (const auto found = cells_.find(cell); found != cells_.end())
    for (Index i : found->second) nearest.try_one(pieces_[i]);
}

ElementPlace ElementLocator::find(const Vector3d& point, const Vector3d& inside) const {
  Nearest nearest{point + kInwards * (inside - point), &pieces_.front()};
  const Cell cell = cell_of(nearest.point);
  look_into(cell, nearest);
  if (nearest.distance > kNear * step_)
    for (std::int64_t z : {-1, 0, 1})
      for (std::int64_t y : {-1, 0, 1})
        for (std::int64_t x : {-1, 0, 1}) look_into({cell[0] + x, cell[1] + y, cell[2] + z}, nearest);
  if (nearest.distance > step_)  // something outside of these cubes may be nearer
    for (const Piece& piece : pieces_) nearest.try_one(piece);
  ElementPlace place = nearest.piece->place;
  place.weights = weights_in(nearest.piece->points, point);
  return place;
}

}  // namespace qmorph::adapter
