// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/volumes/untangle.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "kernel/sort_unique.hpp"

namespace qmorph::adapter {
namespace {

constexpr int kSweeps = 40;
/// Nodes that may move are this many elements away from those that are turned over.
constexpr int kRings = 2;
/// Of the mean edge at a node: the first step of its search, and the last.
constexpr double kFirstStep = 0.25, kLastStep = 0.004;
/// The least volume at a corner that is aimed at, in the mean edge's cube: a cube's corner has 1. Sweep by sweep it
/// gets smaller, for large elements meet small ones, and slivers.
constexpr double kAim = 0.02, kNextAim = 0.75;

/// The three edges of an ideal corner as columns, inverted.
Eigen::Matrix3d inverse_of_ideal(CellShape shape) {
  Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();
  if (shape == CellShape::tetrahedron)
    edges << 1, 0.5, 0.5, 0, std::sqrt(0.75), std::sqrt(1.0 / 12), 0, 0, std::sqrt(2.0 / 3);
  else if (shape == CellShape::pyramid)
    edges << 1, 0, 0.5, 0, 1, 0.5, 0, 0, 0.7;
  else if (shape == CellShape::prism)
    edges << 1, 0.5, 0, 0, std::sqrt(0.75), 0, 0, 0, 1;
  return edges.inverse();
}

class Untangler {
 public:
  explicit Untangler(Solid& solid) : solid_(solid), cells_at_(solid.points.size()) {
    for (std::size_t i = 0; i < kCellShapes.size(); ++i) inverse_[i] = inverse_of_ideal(kCellShapes[i]);
    for (std::size_t c = 0; c < solid.cells.size(); ++c)
      for (std::size_t k = 0; k < nodes_of(solid.cells[c].shape); ++k) cells_at_[solid.cells[c].nodes[k]].push_back(c);
  }

  std::vector<std::size_t> run(std::vector<std::size_t> turned) {
    std::vector<std::size_t> now = turned;
    std::vector<Eigen::Vector3d> best = solid_.points;
    double aim = kAim;
    for (int sweep = 0; sweep < kSweeps && !now.empty(); ++sweep, aim *= kNextAim) {
      for (Index v : nodes_near(now)) move(v, aim);
      now = find_turned(solid_);
      if (now.size() < turned.size()) turned = now, best = solid_.points;
    }
    solid_.points = std::move(best);
    return turned;
  }

 private:
  std::vector<Index> nodes_near(const std::vector<std::size_t>& cells) const {
    std::vector<std::size_t> reached = cells;
    std::vector<Index> nodes;
    for (int ring = 0; ring < kRings; ++ring) {
      nodes.clear();
      for (std::size_t c : reached)
        nodes.insert(nodes.end(), solid_.cells[c].nodes.begin(),
                     solid_.cells[c].nodes.begin() + std::ptrdiff_t(nodes_of(solid_.cells[c].shape)));
      sort_unique(nodes);
      reached.clear();
      for (Index v : nodes) reached.insert(reached.end(), cells_at_[v].begin(), cells_at_[v].end());
      sort_unique(reached);
    }
    std::erase_if(nodes, [&](Index v) { return !solid_.may_move[v]; });
    return nodes;
  }

  double mean_edge(Index v) const {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t c : cells_at_[v])
      for (std::size_t k = 0; k < nodes_of(solid_.cells[c].shape); ++k)
        if (const Index u = solid_.cells[c].nodes[k]; u != v)
          sum += (solid_.points[u] - solid_.points[v]).norm(), ++count;
    return count ? sum / double(count) : 0;
  }

  /// Of the corners of the elements around a node: how far their shapes are from the ideal ones, with a volume that is
  /// positive everywhere and tends to the corner's own as `delta` goes to zero [Escobar03].
  double energy(Index v, double delta) const {
    double sum = 0;
    for (std::size_t c : cells_at_[v]) {
      const Cell& cell = solid_.cells[c];
      const auto shape =
          std::size_t(std::find(kCellShapes.begin(), kCellShapes.end(), cell.shape) - kCellShapes.begin());
      for (const CellCorner& corner : corners_of(cell.shape)) {
        Eigen::Matrix3d edges;
        for (int k = 0; k < 3; ++k)
          edges.col(k) = solid_.points[cell.nodes[corner[std::size_t(k) + 1]]] - solid_.points[cell.nodes[corner[0]]];
        const Eigen::Matrix3d deformation = edges * inverse_[shape];
        const double volume = deformation.determinant();
        const double positive = (volume + std::sqrt(volume * volume + 4 * delta * delta)) / 2;
        const double corner_energy = deformation.squaredNorm() / (3 * std::cbrt(positive * positive));
        sum += corner_energy * corner_energy;
      }
    }
    return sum;
  }

  /// A search along the axes, with steps that get shorter.
  void move(Index v, double aim) {
    const double size = mean_edge(v), delta = aim * size * size * size;
    if (!(size > 0)) return;
    double best = energy(v, delta);
    for (double step = kFirstStep * size; step > kLastStep * size; step /= 2) {
      bool better = false;
      for (int axis = 0; axis < 3; ++axis)
        for (const double way : {step, -step}) {
          const double there = solid_.points[v][axis];
          solid_.points[v][axis] = there + way;
          const double now = energy(v, delta);
          if (now < best)
            best = now, better = true;
          else
            solid_.points[v][axis] = there;
        }
      if (better) step *= 2;
      if (!std::isfinite(best)) return;
    }
  }

  Solid& solid_;
  std::vector<std::vector<std::size_t>> cells_at_;
  std::array<Eigen::Matrix3d, kCellShapes.size()> inverse_;
};

}  // namespace

std::vector<std::size_t> untangle(Solid& solid, std::vector<std::size_t> turned) {
  return Untangler(solid).run(std::move(turned));
}

}  // namespace qmorph::adapter
