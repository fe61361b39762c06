// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/coincident_nodes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace qmorph::adapter {
namespace {

/// Of the size of the whole, as Gmsh has it for removing duplicate nodes.
constexpr double kSamePlace = 1e-8;

/// Cells are so wide that few nodes are near a side of theirs, and so narrow that few nodes share one.
constexpr double kCellWidth = 8 * kSamePlace;

using Cell = std::array<std::int64_t, 3>;

/// Points by the cell of space that they lie in. One of several at the same place is kept.
class Places {
 public:
  Places(std::size_t count, const Eigen::AlignedBox3d& box)
      : low_(box.min()),
        same_place_(kSamePlace * box.diagonal().norm()),
        width_(kCellWidth * box.diagonal().norm()),
        heads_(std::bit_ceil(2 * count + 1), kNone) {
    points_.reserve(count);
    next_.reserve(count);
  }
  /// \return false if one is there already
  bool add(const Eigen::Vector3d& p) {
    if (find(p)) return false;
    Index& head = heads_[slot(cell_of(p))];
    points_.push_back(p);
    next_.push_back(head);
    head = Index(points_.size() - 1);
    return true;
  }

 private:
  Cell cell_of(const Eigen::Vector3d& p) const {
    Cell cell;
    for (int i = 0; i < 3; ++i) cell[i] = width_ > 0 ? std::int64_t(std::floor((p[i] - low_[i]) / width_)) : 0;
    return cell;
  }
  std::size_t slot(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t i : cell) {
      hash = (hash ^ std::uint64_t(i)) * 0x9e3779b97f4a7c15u;  // 2^64 over the golden ratio: spreads neighbours
      hash ^= hash >> 32;
    }
    return hash & (heads_.size() - 1);
  }
  bool find(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(same_place_);
    const Cell low = cell_of(p - reach), high = cell_of(p + reach);
    for (std::int64_t i = low[0]; i <= high[0]; ++i)
      for (std::int64_t j = low[1]; j <= high[1]; ++j)
        for (std::int64_t k = low[2]; k <= high[2]; ++k)
          for (Index at = heads_[slot({i, j, k})]; at != kNone; at = next_[at])
            if ((points_[at] - p).norm() <= same_place_) return true;
    return false;
  }

  const Eigen::Vector3d low_;
  const double same_place_, width_;
  std::vector<Index> heads_, next_;
  std::vector<Eigen::Vector3d> points_;
};

}  // namespace

CoincidentNodes find_coincident_nodes(const ModelMesh& mesh, const NodeUse& use) {
  Eigen::AlignedBox3d box;
  std::vector<Index> rows;
  for (Index row = 0; row < mesh.tags.size(); ++row) {
    if (use.surface[row] == kNobody || !mesh.points[row].allFinite()) continue;
    rows.push_back(row);
    box.extend(mesh.points[row]);
  }
  CoincidentNodes found;
  if (rows.empty() || !std::isfinite(box.diagonal().norm())) return found;
  Places places(rows.size(), box);
  for (const Index row : rows) {
    if (places.add(mesh.points[row])) continue;
    if (found.count++ == 0) found.first = row;
  }
  return found;
}

}  // namespace qmorph::adapter
