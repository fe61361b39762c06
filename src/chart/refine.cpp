// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/refine.hpp"

namespace qmorph::chart {
namespace {

class Refining {
 public:
  Refining(const SurfaceMesh& mesh, const std::vector<Edge>& kept)
      : mesh_(mesh), middle_(4 * mesh.faces.size(), kNone) {
    result_.points = mesh.points;
    result_.on = mesh.on;
    result_.fixed = mesh.fixed;
    result_.node = mesh.node;
    const std::vector<Index> opposite = opposite_sides(mesh);
    const std::vector<bool> stays = sides_on(mesh, kept);
    for (Index side = 0; side < opposite.size(); ++side) {
      const Index other = opposite[side];
      if (other == kNone || other < side || stays[side]) continue;
      const Face& face = mesh.faces[side / 4];
      const Eigen::Vector3d p = 0.5 * (mesh.points[face[side % 4]] + mesh.points[face[next_corner(face, side % 4)]]);
      middle_[side] = middle_[other] = result_.add_point(p, mesh.near[side / 4]);
    }
  }

  SurfaceMesh run() {
    for (Index f = 0; f < mesh_.faces.size(); ++f) cut(f);
    return std::move(result_);
  }

 private:
  /// Corners and middles all around; ears are cut off at corners between two middles, and what is left is a fan.
  void cut(Index f) {
    struct Corner {
      Index node;
      bool open;  ///< the side that follows
      bool is_middle;
    };
    std::vector<Corner> ring;
    for (Index i = 0; i < 3; ++i) {
      const Index side = 4 * f + i;
      ring.push_back({mesh_.faces[f][i], mesh_.open[side], false});
      if (middle_[side] != kNone) ring.push_back({middle_[side], false, true});
    }
    for (std::size_t k = 0; k < ring.size() && ring.size() > 3;) {
      const std::size_t after = (k + 1) % ring.size(), before = (k + ring.size() - 1) % ring.size();
      if (ring[k].is_middle || !ring[before].is_middle || !ring[after].is_middle) {
        ++k;
        continue;
      }
      add(f, {ring[before].node, ring[k].node, ring[after].node}, {ring[before].open, ring[k].open, false});
      ring[before].open = false;
      ring.erase(ring.begin() + std::ptrdiff_t(k));
    }
    // From a middle, if there is one, so that no triangle is flat.
    std::size_t first = 0;
    while (first + 1 < ring.size() && !ring[first].is_middle) ++first;
    const auto at = [&](std::size_t k) -> const Corner& { return ring[(first + k) % ring.size()]; };
    for (std::size_t k = 1; k + 1 < ring.size(); ++k)
      add(f, {at(0).node, at(k).node, at(k + 1).node},
          {k == 1 && at(0).open, at(k).open, k + 2 == ring.size() && at(k + 1).open});
  }

  void add(Index f, const std::array<Index, 3>& corners, const std::array<bool, 3>& open) {
    result_.faces.push_back({corners[0], corners[1], corners[2], kNone});
    result_.near.push_back(mesh_.near[f]);
    for (int i = 0; i < 4; ++i) result_.open.push_back(i < 3 && open[i]);
  }

  const SurfaceMesh& mesh_;
  std::vector<Index> middle_;  ///< by side
  SurfaceMesh result_;
};

}  // namespace

SurfaceMesh refined(const SurfaceMesh& mesh, const std::vector<Edge>& kept) { return Refining(mesh, kept).run(); }

}  // namespace qmorph::chart
