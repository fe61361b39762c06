// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/meetings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "qmorph/quality.hpp"

namespace qmorph::layers {

Meetings look_at_meetings(const Layers& layers, std::size_t given, const QuadMesh& mesh) {
  constexpr double kPoor = 0.3, kDegree = std::numbers::pi / 180;
  const std::size_t kept = layers.patch.quads.size();
  std::vector<bool> is_of_layer(mesh.points.size(), false);
  for (std::size_t q = given; q < kept; ++q)
    for (Index v : mesh.quads[q]) is_of_layer[v] = true;
  Meetings found;
  double sum = 0;
  for (std::size_t q = kept; q < mesh.quads.size(); ++q) {
    QuadCorners corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh.points[mesh.quads[q][i]];
    const Eigen::Vector3d normal = (corners[2] - corners[0]).cross(corners[3] - corners[1]).normalized();
    double least = 1;
    const std::array<double, 4> angles = corner_angles_deg(corners, normal);
    for (std::size_t i = 0; i < 4; ++i) {
      const double sine = std::sin(kDegree * angles[i]);
      const Index v = mesh.quads[q][i];
      least = std::min(least, sine);
      if (sine < kPoor && is_of_layer[v] && mesh.source[v] != kNone) found.narrow_nodes.push_back(mesh.source[v]);
    }
    found.poor += least < kPoor;
    found.least = std::min(found.least, least);
    sum += least;
  }
  if (mesh.quads.size() > kept) found.mean = sum / double(mesh.quads.size() - kept);
  return found;
}

}  // namespace qmorph::layers
