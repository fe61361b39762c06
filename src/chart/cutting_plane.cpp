// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/cutting_plane.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "chart/topology.hpp"
#include "geometry/cut_cost.hpp"

namespace qmorph::chart {
namespace {

using Eigen::Vector3d;

constexpr double kShifts[] = {0, -0.08, 0.08, -0.16, 0.16};  ///< of the share
/// A plane that has less than this of the wanted share behind it does not cut.
constexpr double kLeastShare = 0.3;
/// Costs are estimated from so many faces.
constexpr std::size_t kSamples = 1500;

struct CuttingPlane {
  Vector3d normal = Vector3d::UnitX();
  double offset = 0;
  double distance(const Vector3d& p) const { return normal.dot(p) - offset; }
};

struct Sample {
  std::array<Vector3d, 3> corners;
  Vector3d middle;
  double radius;  ///< around the middle: no corner is farther away
};

/// A side of the outline, with the normal of its face.
struct OutlineSide {
  Vector3d from, to, normal;
};

Vector3d middle_of(const Piece& piece, Index f) {
  Vector3d sum = Vector3d::Zero();
  for (Index i = 0; i < degree(piece.faces[f]); ++i) sum += piece.points[piece.faces[f][i]];
  return sum / double(degree(piece.faces[f]));
}

Vector3d normal_of(const std::array<Vector3d, 3>& t) { return (t[1] - t[0]).cross(t[2] - t[0]).normalized(); }

class Chooser {
 public:
  Chooser(const Piece& piece, double share) : share_(share) {
    const std::size_t step = 1 + piece.halves.size() / kSamples;
    weight_ = double(step);
    for (std::size_t h = 0; h < piece.halves.size(); h += step) {
      const auto& [a, b, c] = piece.halves[h];
      const std::array<Vector3d, 3> t{piece.points[a], piece.points[b], piece.points[c]};
      const Vector3d middle = (t[0] + t[1] + t[2]) / 3;
      double radius2 = 0;
      for (const Vector3d& corner : t) radius2 = std::max(radius2, (corner - middle).squaredNorm());
      samples_.push_back({t, middle, 1.01 * std::sqrt(radius2)});
    }
    for (Index side = 0; side < piece.open.size(); ++side) {
      if (!piece.open[side]) continue;
      const Face& face = piece.faces[side / 4];
      const std::array<Vector3d, 3> t{piece.points[face[0]], piece.points[face[1]], piece.points[face[2]]};
      outline_.push_back({piece.points[face[side % 4]], piece.points[face[next_corner(face, side % 4)]], normal_of(t)});
    }
  }

  CuttingPlane best() const {
    CuttingPlane best;
    double least = std::numeric_limits<double>::infinity();
    std::vector<double> offsets(samples_.size());
    for (const Vector3d& normal : directions()) {
      for (std::size_t k = 0; k < samples_.size(); ++k) offsets[k] = normal.dot(samples_[k].middle);
      std::sort(offsets.begin(), offsets.end());
      for (double shift : kShifts) {
        const double rank = std::clamp(share_ + shift, 0.0, 1.0) * double(offsets.size() - 1);
        const CuttingPlane plane{normal, offsets[std::size_t(rank)]};
        const auto behind = std::lower_bound(offsets.begin(), offsets.end(), plane.offset) - offsets.begin();
        if (double(behind) < kLeastShare * share_ * double(offsets.size())) continue;  // most lie in the plane
        const double cost = cost_of(plane, offsets.back() - offsets.front());
        if (cost < least) best = plane, least = cost;
      }
    }
    return best;
  }

 private:
  /// The main axes of the piece, and directions all around.
  std::vector<Vector3d> directions() const {
    Vector3d mean = Vector3d::Zero();
    for (const Sample& s : samples_) mean += s.middle;
    mean /= double(samples_.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Sample& s : samples_) spread += (s.middle - mean) * (s.middle - mean).transpose();
    const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
    std::vector<Vector3d> result;
    for (int i = 2; i >= 0; --i) result.push_back(axes.col(i));
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = 0; z <= 1; ++z)
          if (z > 0 || y > 0 || (y == 0 && x > 0)) result.push_back(Vector3d(x, y, z).normalized());
    return result;
  }

  double cost_of(const CuttingPlane& plane, double extent) const {
    double cost = 0;
    for (const Sample& s : samples_) {
      if (std::abs(plane.distance(s.middle)) > s.radius) continue;
      Vector3d ends[2];
      int count = 0;
      for (int i = 0; i < 3 && count < 2; ++i) {
        const Vector3d &a = s.corners[i], &b = s.corners[(i + 1) % 3];
        const double da = plane.distance(a), db = plane.distance(b);
        if ((da < 0) != (db < 0)) ends[count++] = a + (b - a) * (da / (da - db));
      }
      if (count == 2) cost += weight_ * (ends[1] - ends[0]).norm();
    }
    for (const OutlineSide& side : outline_) {
      if ((plane.distance(side.from) < 0) == (plane.distance(side.to) < 0)) continue;
      const Vector3d along = plane.normal.cross(side.normal).normalized();
      const double sine = along.cross((side.to - side.from).normalized()).norm();
      cost += extent * cost_of_cut_end(sine);
    }
    return cost;
  }

  const double share_;
  double weight_ = 1;
  std::vector<Sample> samples_;
  std::vector<OutlineSide> outline_;
};

/// Faces across the sides of a piece; kNone where it ends.
std::vector<Index> neighbours_of(const Piece& piece) {
  SurfaceMesh mesh;
  mesh.points = piece.points;
  mesh.faces = piece.faces;
  mesh.open = piece.open;
  return opposite_sides(mesh);
}

/// A face with more neighbours on the other side than on its own goes there, which shortens the curve.
void even_out(const Piece& piece, std::vector<char>& beyond) {
  const std::vector<Index> opposite = neighbours_of(piece);
  std::vector<Index> waiting;
  const auto visit_neighbours = [&](Index f, const auto& visit) {
    for (Index side = 4 * f; side < 4 * f + 4; ++side)
      if (opposite[side] != kNone) visit(opposite[side] / 4);
  };
  for (Index f = 0; f < piece.faces.size(); ++f) waiting.push_back(f);
  while (!waiting.empty()) {
    const Index f = waiting.back();
    waiting.pop_back();
    int others = 0, same = 0;
    visit_neighbours(f, [&](Index g) { (beyond[g] == beyond[f] ? same : others)++; });
    if (others <= same) continue;
    beyond[f] = !beyond[f];
    visit_neighbours(f, [&](Index g) { waiting.push_back(g); });
  }
}

}  // namespace

std::vector<char> sides_of_best_plane(const Piece& piece, double share) {
  const CuttingPlane plane = Chooser(piece, share).best();
  std::vector<char> beyond(piece.faces.size());
  for (Index f = 0; f < piece.faces.size(); ++f) beyond[f] = plane.distance(middle_of(piece, f)) >= 0;
  even_out(piece, beyond);
  return beyond;
}

}  // namespace qmorph::chart
