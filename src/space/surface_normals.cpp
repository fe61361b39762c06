// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/surface_normals.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "space/triangle_tree.hpp"
#include "space/unit.hpp"

namespace qmorph::space {
namespace {

using Eigen::Vector3d;

template <std::size_t N>
Vector3d centre_of(const Corners<N>& p) {
  Vector3d sum = p[0];
  for (std::size_t i = 1; i < N; ++i) sum += p[i];
  return sum / double(N);
}

/// A side of the surface where it parts. Whichever way it runs: an element that is turned over is to be found on its
/// own side.
struct OpenSide {
  Index low, high, triangle;
};

/// In the order of their ends.
std::vector<OpenSide> open_sides(const Background& surface) {
  std::vector<OpenSide> sides;
  for (Index t = 0; t < surface.triangles(); ++t)
    for (int i = 0; i < 3; ++i) {
      if (surface.neighbour(t, i) != kNone) continue;
      const auto [low, high] = std::minmax(surface.corners(t)[i], surface.corners(t)[(i + 1) % 3]);
      sides.push_back({low, high, t});
    }
  std::sort(sides.begin(), sides.end(), [](const OpenSide& a, const OpenSide& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

/// Whether a foot's point lies on the triangle as good as exactly, so that no other one can be meant.
bool is_on(const Background& surface, const Foot& foot) {
  constexpr double kOn = 1e-3;  // of a side
  const Vector3d &a = surface.corner(foot.triangle, 0), &b = surface.corner(foot.triangle, 1);
  return foot.distance2 <= kOn * kOn * (b - a).squaredNorm();
}

class Search {
 public:
  Search(const ElementsOnSurface& mesh, const ElementSides& sides, const SurfaceNormals& normals)
      : mesh_(mesh), sides_(sides), normals_(normals), found_(sides.elements(), kNone) {}

  std::vector<Index> run() {
    if (mesh_.surface.triangles() == 0) return std::move(found_);
    start_at_open_sides();
    spread();
    std::optional<TriangleTree> tree;
    for (Index e = 0; e < found_.size(); ++e) {
      if (found_[e] != kNone) continue;
      if (!tree) tree.emplace(mesh_.surface.points(), mesh_.surface.all_corners());
      found_[e] = tree->closest(centre(e)).triangle;
      if (found_[e] == kNone) found_[e] = 0;  // NaN
      queue_.push_back(e);
      spread();
    }
    return std::move(found_);
  }

 private:
  Vector3d centre(Index e) const {
    Vector3d sum = Vector3d::Zero();
    for (Index i = 0; i < sides_.degree(e); ++i) sum += mesh_.points[sides_.node(4 * e + i)];
    return sum / double(sides_.degree(e));
  }

  void start_at_open_sides() {
    if (mesh_.source.empty()) return;
    const std::vector<OpenSide> open = open_sides(mesh_.surface);
    for (Index side = 0; side < sides_.slots(); ++side) {
      const Index e = side / 4;
      if (sides_.node(side) == kNone || sides_.opposite(side) != kNone || found_[e] != kNone) continue;
      const Index a = mesh_.source[sides_.node(side)], b = mesh_.source[sides_.target(side)];
      if (a == kNone || b == kNone) continue;
      const OpenSide key{std::min(a, b), std::max(a, b), 0};
      const auto before = [](const OpenSide& x, const OpenSide& y) {
        return std::tie(x.low, x.high) < std::tie(y.low, y.high);
      };
      const auto [first, last] = std::equal_range(open.begin(), open.end(), key, before);
      Foot best;
      for (auto it = first; it != last; ++it) {
        const Foot foot = mesh_.surface.walk(centre(e), it->triangle);
        if (best.triangle == kNone || foot.distance2 < best.distance2) best = foot;
      }
      if (best.triangle == kNone) continue;
      found_[e] = best.triangle;
      queue_.push_back(e);
    }
  }

  /// From the elements in the queue to all that are joined to them.
  void spread() {
    for (std::size_t done = 0; done < queue_.size(); ++done)
      for (Index side = 4 * queue_[done]; side < 4 * queue_[done] + 4; ++side) {
        if (sides_.opposite(side) == kNone) continue;
        const Index other = sides_.opposite(side) / 4;
        if (found_[other] != kNone) continue;
        found_[other] = normals_.closest(centre(other), found_[side / 4]).triangle;
        queue_.push_back(other);
      }
    queue_.clear();
  }

  const ElementsOnSurface& mesh_;
  const ElementSides& sides_;
  const SurfaceNormals& normals_;
  std::vector<Index> found_;  ///< by element
  std::vector<Index> queue_;
};

}  // namespace

SurfaceNormals::SurfaceNormals(const Background& surface) : surface_(surface) {
  bool is_smooth = true;
  for (Index t = 0; t < surface.triangles() && is_smooth; ++t) is_smooth = surface.is_smooth(t);
  if (is_smooth) return;
  tree_.emplace(surface.points(), surface.all_corners());
  part_.assign(surface.triangles(), kNone);
  std::vector<Index> queue;
  for (Index first = 0; first < surface.triangles(); ++first) {
    if (part_[first] != kNone) continue;
    part_[first] = first;
    queue.assign(1, first);
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (int i = 0; i < 3; ++i)
        if (const Index t = surface.neighbour(queue[k], i); t != kNone && part_[t] == kNone)
          part_[t] = first, queue.push_back(t);
  }
}

Foot SurfaceNormals::closest(const Vector3d& p, Index hint) const {
  const Foot walked = surface_.walk(p, hint);
  if (!tree_ || (surface_.is_smooth(walked.triangle) && is_on(surface_, walked))) return walked;
  // Triangles that share the closest point are equally near: which of them it is must not depend on the hint.
  constexpr double kAsNear = 1e-9;
  const double side = (surface_.corner(walked.triangle, 1) - surface_.corner(walked.triangle, 0)).norm();
  const double within = (1 + kAsNear) * std::sqrt(walked.distance2) + kAsNear * side;
  const Foot found = tree_->closest(p, within, part_, part_[hint]);
  return found.triangle == kNone ? walked : found;
}

template <std::size_t N>
CornerNormals<N> SurfaceNormals::of(const Corners<N>& p, Index hint) const {
  constexpr double kToCentre = 0.25;
  const Vector3d centre = centre_of(p);
  const Index middle = closest(centre, hint).triangle;
  CornerNormals<N> normals;
  normals.whole = surface_.normal_near(middle);
  for (std::size_t i = 0; i < N; ++i) {
    normals.at[i] = surface_.normal_near(closest(p[i] + kToCentre * (centre - p[i]), middle).triangle);
    normals.whole += normals.at[i];
  }
  normals.whole = unit(normals.whole);
  return normals;
}

template CornerNormals<3> SurfaceNormals::of(const Corners<3>&, Index) const;
template CornerNormals<4> SurfaceNormals::of(const Corners<4>&, Index) const;

std::vector<Index> locate(const ElementsOnSurface& mesh, const ElementSides& sides, const SurfaceNormals& normals) {
  return Search(mesh, sides, normals).run();
}

}  // namespace qmorph::space
