// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/surfaces.hpp"

namespace qmorph::test {

namespace {

using Eigen::Vector3d;

constexpr double kLarge = 1, kSmall = 0.4;  // radii

/// Adds a torus on one side, with a hole where its outer equator is nearest to the other one. \return the hole's rim
std::vector<Index> add_torus(Patch& patch, bool on_the_right, double size, Rng& rng) {
  Patch one = torus(kLarge, kSmall, size, rng);
  const double sign = on_the_right ? -1 : 1;
  for (Vector3d& p : one.points) p = Vector3d(sign * (p.x() - 1.55), sign * p.y(), p.z());
  const int across = 2 * count_for(std::numbers::pi * kSmall, size, 3),
            around = 2 * (count_for(2 * std::numbers::pi * kLarge, size, 8) / 2);
  const int half = 1 + int(kSmall / size / 2);
  std::vector<char> gone(one.triangles.size(), 0);
  const auto cell = [&](int i, int j) { return 2 * (((i + around) % around) * across + (j + across) % across); };
  for (int i = -half; i < half; ++i)
    for (int j = -half; j < half; ++j) gone[cell(i, j)] = gone[cell(i, j) + 1] = 1;
  const Index first = Index(patch.points.size());
  const auto node = [&](int i, int j) {
    return first + Index(((i + around) % around) * across + (j + across) % across);
  };
  std::vector<Index> rim;
  for (int k = -half; k < half; ++k) rim.push_back(node(-half, k));
  for (int k = -half; k < half; ++k) rim.push_back(node(k, half));
  for (int k = half; k > -half; --k) rim.push_back(node(half, k));
  for (int k = half; k > -half; --k) rim.push_back(node(k, -half));
  patch.points.insert(patch.points.end(), one.points.begin(), one.points.end());
  for (std::size_t t = 0; t < one.triangles.size(); ++t)
    if (!gone[t])
      patch.triangles.push_back(
          {one.triangles[t][0] + first, one.triangles[t][1] + first, one.triangles[t][2] + first});
  return rim;
}

/// Joins rims that face each other by a tube.
void add_tube(Patch& patch, const std::vector<Index>& first, const std::vector<Index>& second, double size) {
  std::size_t shift = 0;
  double least = 1e300;
  for (std::size_t s = 0; s < second.size(); ++s) {
    double sum = 0;
    for (std::size_t k = 0; k < first.size(); ++k)
      sum += (patch.points[first[k]] - patch.points[second[(k + s) % second.size()]]).norm();
    if (sum < least) least = sum, shift = s;
  }
  const std::size_t n = first.size();
  const int rings = count_for(least / double(n), size, 1);
  std::vector<Index> before = first;
  for (int ring = 1; ring <= rings; ++ring) {
    std::vector<Index> here;
    for (std::size_t k = 0; k < n; ++k) {
      const Index goal = second[(k + shift) % n];
      if (ring == rings) {
        here.push_back(goal);
        continue;
      }
      here.push_back(Index(patch.points.size()));
      const double share = double(ring) / rings;
      patch.points.push_back((1 - share) * patch.points[first[k]] + share * patch.points[goal]);
    }
    for (std::size_t k = 0; k < n; ++k) {
      const Index a = before[k], b = before[(k + 1) % n], c = here[(k + 1) % n], d = here[k];
      patch.triangles.push_back({b, a, d});
      patch.triangles.push_back({b, d, c});
    }
    before = here;
  }
}

/// Nodes near the seam go to the middle of their neighbours.
void smooth_seam(Patch& patch) {
  std::vector<std::vector<Index>> neighbours(patch.points.size());
  for (const auto& t : patch.triangles)
    for (int i = 0; i < 3; ++i) neighbours[t[i]].push_back(t[(i + 1) % 3]);
  for (int pass = 0; pass < 8; ++pass)
    for (Index v = 0; v < patch.points.size(); ++v) {
      if (std::abs(patch.points[v].x()) > 0.45) continue;
      Vector3d sum = Vector3d::Zero();
      for (Index w : neighbours[v]) sum += patch.points[w];
      patch.points[v] = sum / double(neighbours[v].size());
    }
}

}  // namespace

/// Two tori side by side, joined by a short tube between holes that face each other.
Patch double_torus(double size, Rng& rng) {
  Patch patch;
  const std::vector<Index> first = add_torus(patch, false, size, rng);
  std::vector<Index> second = add_torus(patch, true, size, rng);
  std::reverse(second.begin(), second.end());  // rims run the same way as seen from their own torus
  add_tube(patch, first, second, size);
  drop_unused(patch);
  smooth_seam(patch);
  return patch;
}

}  // namespace qmorph::test
