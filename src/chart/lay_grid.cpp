// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/lay_grid.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bands/find_band.hpp"
#include "chart/chart.hpp"
#include "engine/worth.hpp"
#include "space/angle_sum.hpp"

namespace qmorph::chart {
namespace {

using Eigen::Vector3d;

/// Sharper nodes of the boundary are corners; wider ones than the second would be reflex.
constexpr double kCorner = 0.75 * std::numbers::pi, kReflex = 1.25 * std::numbers::pi;
/// There may be so many times the quads that take the place of the triangles, or as few.
constexpr double kMostGrowth = 1.35;
/// By what factor quads are longer or shorter than the triangles there, on average and at most.
constexpr double kMeanRatio = 1.25, kMostRatio = 2;

/// A region whose boundary is four sides around a grid of `columns` times `rows` quads.
struct FourSides {
  bands::Loop loop;  ///< from the first corner on
  Index columns = 0, rows = 0;
};

std::optional<FourSides> find_four_sides(const CurvedRegion& region) {
  const Region& its = region.region;
  if (its.boundary_sides % 2 != 0 || !region.tips.empty() || !region.creases.empty()) return {};
  // A disc, by Euler's formula.
  if (2 * its.node.size() != its.triangles.size() + its.boundary_sides + 2) return {};
  std::vector<bands::Loop> loops = bands::boundary_of(its);
  if (loops.size() != 1 || loops[0].size() != its.boundary_sides) return {};
  bands::Loop& loop = loops[0];
  std::vector<char> is_outer(region.points.size(), 0);
  for (Index v : loop) is_outer[v] = 1;
  if (std::any_of(its.fixed.begin(), its.fixed.end(), [&](Index v) { return !is_outer[v]; })) return {};
  std::vector<space::AngleSum> angles(region.points.size());
  for (const auto& t : its.triangles)
    for (int i = 0; i < 3; ++i) {
      const Vector3d& at = region.points[t[i]];
      angles[t[i]].add(region.points[t[(i + 1) % 3]] - at, region.points[t[(i + 2) % 3]] - at);
    }
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const double angle = angles[loop[i]].radians();
    if (angle > kReflex) return {};
    if (angle < kCorner) corners.push_back(i);
  }
  if (corners.size() != 4) return {};
  const std::size_t columns = corners[1] - corners[0], rows = corners[2] - corners[1];
  if (corners[3] - corners[2] != columns || 2 * (columns + rows) != loop.size()) return {};
  std::rotate(loop.begin(), loop.begin() + std::ptrdiff_t(corners[0]), loop.end());
  return FourSides{std::move(loop), Index(columns), Index(rows)};
}

/// The region's triangles over the rectangle from (0, 0) to (columns, rows), none turned over [Tutte63]: each node
/// inside is at a mean of its neighbours, with weights that keep shapes where they may.
class Rectangle {
 public:
  Rectangle(const CurvedRegion& region, const FourSides& sides)
      : region_(region), place_(region.points.size(), Vec2(0, 0)), unknown_(region.points.size(), 0) {
    const Index columns = sides.columns, rows = sides.rows;
    for (Index k = 0; k < sides.loop.size(); ++k) {
      unknown_[sides.loop[k]] = kNone;
      place_[sides.loop[k]] = k <= columns              ? Vec2(k, 0)
                              : k <= columns + rows     ? Vec2(columns, k - columns)
                              : k <= 2 * columns + rows ? Vec2(2 * columns + rows - k, rows)
                                                        : Vec2(0, 2 * (columns + rows) - k);
    }
    for (Index& unknown : unknown_)
      if (unknown != kNone) unknown = unknowns_++;
  }

  /// Places of the region's points. \return nothing if the solver fails
  std::optional<std::vector<Vec2>> lay_out() {
    if (unknowns_ == 0) return place_;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(unknowns_, 2);
    for (Index side = 0; side < 3 * region_.region.triangles.size(); ++side) {
      const auto& t = region_.region.triangles[side / 3];
      const Index a = t[side % 3], b = t[(side + 1) % 3];
      const double weight = weight_of(a, b, t[(side + 2) % 3]);
      for (const auto& [v, w] : {std::pair(a, b), std::pair(b, a)}) {
        if (unknown_[v] == kNone) continue;
        entries.emplace_back(unknown_[v], unknown_[v], weight);
        if (unknown_[w] != kNone)
          entries.emplace_back(unknown_[v], unknown_[w], -weight);
        else
          right.row(unknown_[v]) += weight * Eigen::RowVector2d(place_[w].x(), place_[w].y());
      }
    }
    Eigen::SparseMatrix<double> matrix(unknowns_, unknowns_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    if (solver.info() != Eigen::Success) return {};
    const Eigen::MatrixX2d places = solver.solve(right);
    if (!places.allFinite()) return {};
    for (Index v = 0; v < place_.size(); ++v)
      if (unknown_[v] != kNone) place_[v] = Vec2(places(unknown_[v], 0), places(unknown_[v], 1));
    return place_;
  }

 private:
  /// The cotangent of the angle across from the edge, but positive.
  double weight_of(Index a, Index b, Index across) const {
    constexpr double kLeast = 0.1, kMost = 10;
    const Vector3d u = region_.points[a] - region_.points[across], v = region_.points[b] - region_.points[across];
    const double sine = u.cross(v).norm(), cosine = u.dot(v);
    return sine * kMost <= cosine ? kMost : std::max(kLeast, cosine / sine);
  }

  const CurvedRegion& region_;
  std::vector<Vec2> place_;
  std::vector<Index> unknown_;  ///< by point; kNone on the boundary
  Index unknowns_ = 0;
};

class GridLayer {
 public:
  GridLayer(const CurvedRegion& region, FourSides sides, std::vector<Vec2> places)
      : region_(region),
        sides_(std::move(sides)),
        chart_(region.points, region.region.triangles, region.barriers, {.points = std::move(places)}) {}

  SurfaceMesh run() {
    mesh_ = region_.triangles();
    mesh_.faces.clear(), mesh_.open.clear(), mesh_.near.clear();
    for (Index j = 0; j <= rows(); ++j)
      for (Index i = 0; i <= columns(); ++i) node_.push_back(add_node(i, j));
    for (Index j = 0; j < rows(); ++j)
      for (Index i = 0; i < columns(); ++i) {
        mesh_.faces.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
        for (const bool is_open : {j == 0, i + 1 == columns(), j + 1 == rows(), i == 0}) mesh_.open.push_back(is_open);
        mesh_.near.push_back(mesh_.on[node(i, j)]);
      }
    return std::move(mesh_);
  }

 private:
  Index columns() const { return sides_.columns; }
  Index rows() const { return sides_.rows; }
  Index node(Index i, Index j) const { return node_[j * (columns() + 1) + i]; }

  Index add_node(Index i, Index j) {
    if (j == 0) return sides_.loop[i];
    if (i == columns()) return sides_.loop[columns() + j];
    if (j == rows()) return sides_.loop[2 * columns() + rows() - i];
    if (i == 0) return sides_.loop[2 * (columns() + rows()) - j];
    const Chart::Place place = chart_.locate(Vec2(i, j), mesh_.on[node_.back()]);
    return mesh_.add_point(chart_.to_space(place), place.half);
  }

  const CurvedRegion& region_;
  const FourSides sides_;
  const Chart chart_;
  SurfaceMesh mesh_;
  std::vector<Index> node_;  ///< of the grid, row by row
};

/// Sides that end inside, beside the edges of the triangles there.
bool has_sizes_of_triangles(const SurfaceMesh& mesh, const CurvedRegion& region) {
  double sum = 0, most = 0;
  std::size_t count = 0;
  for (const Face& face : mesh.faces)
    for (Index i = 0; i < 4; ++i) {
      const Index a = face[i], b = face[next_corner(face, i)];
      if (a < region.points.size()) continue;
      const auto& t = region.region.triangles[mesh.on[a]];
      double edge = 0;
      for (int k = 0; k < 3; ++k) edge += (region.points[t[(k + 1) % 3]] - region.points[t[k]]).norm() / 3;
      const double ratio = std::abs(std::log((mesh.points[b] - mesh.points[a]).norm() / edge));
      sum += ratio, ++count;
      most = std::max(most, ratio);
    }
  return count == 0 || (sum <= std::log(kMeanRatio) * double(count) && most <= std::log(kMostRatio));
}

}  // namespace

std::optional<SurfaceMesh> lay_grid(const CurvedRegion& region, GridSizes sizes) {
  std::optional<FourSides> four = find_four_sides(region);
  if (!four) return {};
  const double growth =
      kTrianglesPerQuad * double(four->columns) * double(four->rows) / double(region.region.triangles.size());
  if (growth > kMostGrowth || growth < 1 / kMostGrowth) return {};
  auto places = Rectangle(region, *four).lay_out();
  if (!places) return {};
  SurfaceMesh mesh = GridLayer(region, std::move(*four), std::move(*places)).run();
  if (sizes == GridSizes::as_triangles && !has_sizes_of_triangles(mesh, region)) return {};
  return mesh;
}

}  // namespace qmorph::chart
