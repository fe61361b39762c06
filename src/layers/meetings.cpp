// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/meetings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "qmorph/quality.hpp"

namespace qmorph::layers {
namespace {

/// Sines of corner angles.
constexpr double kPoor = 0.3, kSlanting = 0.7;

std::array<double, 4> sines_of(const QuadMesh& mesh, std::size_t q) {
  constexpr double kDegree = std::numbers::pi / 180;
  QuadCorners corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh.points[mesh.quads[q][i]];
  const Eigen::Vector3d normal = (corners[2] - corners[0]).cross(corners[3] - corners[1]).normalized();
  std::array<double, 4> sines = corner_angles_deg(corners, normal);
  for (double& angle : sines) angle = std::sin(kDegree * angle);
  return sines;
}

struct Sum {
  Shapes shapes;
  double sum = 0;
  std::size_t count = 0;

  void add(double least) {
    shapes.poor += least < kPoor;
    shapes.least = std::min(shapes.least, least);
    sum += least;
    shapes.mean = sum / double(++count);
  }
};

/// The cells that slant. A column hangs together along the side to which it does.
class SlantingCells {
 public:
  void add(const std::vector<Index>& slanting_corners, bool is_poor) {
    if (slanting_corners.empty()) return;
    for (Index v : slanting_corners) at_node_[v].push_back(cells_.size());
    if (is_poor) poor_.push_back(cells_.size());
    cells_.push_back(slanting_corners);
  }

  /// Their corners, of all that hang together with poor ones; of none if these are too few for a column.
  std::vector<Index> nodes() const {
    constexpr std::size_t kFewest = 4;
    if (poor_.size() < kFewest) return {};
    std::vector<std::size_t> open = poor_;
    std::vector<bool> is_known(cells_.size(), false);
    std::vector<Index> found;
    while (!open.empty()) {
      const std::size_t cell = open.back();
      open.pop_back();
      if (is_known[cell]) continue;
      is_known[cell] = true;
      for (Index v : cells_[cell]) {
        found.push_back(v);
        const auto& around = at_node_.at(v);
        open.insert(open.end(), around.begin(), around.end());
      }
    }
    return found;
  }

 private:
  std::vector<std::vector<Index>> cells_;  ///< their slanting corners
  std::vector<std::size_t> poor_;
  std::map<Index, std::vector<std::size_t>> at_node_;
};

}  // namespace

Meetings look_at_meetings(const Layers& layers, std::size_t given, const QuadMesh& mesh) {
  const std::size_t kept = layers.patch.quads.size();
  std::vector<bool> is_of_layer(mesh.points.size(), false);
  const auto corners_below = [&](double sine, std::size_t q, const std::array<double, 4>& sines) {
    std::vector<Index> nodes;
    for (std::size_t i = 0; i < 4; ++i) {
      const Index v = mesh.quads[q][i];
      if (sines[i] < sine && is_of_layer[v] && mesh.source[v] != kNone) nodes.push_back(mesh.source[v]);
    }
    return nodes;
  };
  Sum front, all;
  SlantingCells slanting;
  Meetings found;
  for (std::size_t q = given; q < mesh.quads.size(); ++q) {
    const std::array<double, 4> sines = sines_of(mesh, q);
    const double least = *std::min_element(sines.begin(), sines.end());
    all.add(least);
    if (q < kept) {
      for (Index v : mesh.quads[q]) is_of_layer[v] = true;
      if (least < kSlanting) slanting.add(corners_below(kSlanting, q, sines), least < kPoor);
      continue;
    }
    front.add(least);
    if (least >= kPoor) continue;
    const std::vector<Index> narrow = corners_below(kPoor, q, sines);
    found.narrow_nodes.insert(found.narrow_nodes.end(), narrow.begin(), narrow.end());
  }
  found.of_front = front.shapes;
  found.of_all = all.shapes;
  found.slanting_nodes = slanting.nodes();
  return found;
}

}  // namespace qmorph::layers
