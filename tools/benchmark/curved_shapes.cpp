// SPDX-License-Identifier: GPL-2.0-or-later
#include "curved_shapes.hpp"

#include <cmath>
#include <map>
#include <numbers>

namespace benchmark {

using Eigen::Vector3d;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
const double kRowHeight = std::sqrt(3.0) / 2;

/// Rows of nodes, each closed, every second one half an edge further; the last is joined to the first if `is_closed`.
std::vector<std::array<Index, 3>> ring_triangles(int around, int rows, bool is_closed) {
  std::vector<std::array<Index, 3>> triangles;
  const auto node = [&](int i, int j) { return Index((j % rows) * around + (i + around) % around); };
  for (int j = 0; j + (is_closed ? 0 : 1) < rows; ++j)
    for (int i = 0; i < around; ++i) {
      const int up = i + j % 2;  // the node above the edge from i to i + 1
      triangles.push_back({node(i, j), node(i + 1, j), node(up, j + 1)});
      triangles.push_back({node(up, j + 1), node(up - 1, j + 1), node(i, j)});
    }
  return triangles;
}

/// Visits the nodes of such rows: column and row, moved by up to `jitter` of an edge unless `stays`.
template <class Visit, class Stays>
void for_ring_nodes(int around, int rows, double jitter, Random& random, const Stays& stays, const Visit& visit) {
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < around; ++i) {
      const double most = stays(j) ? 0 : jitter;
      const double x = random.between(-most, most), y = random.between(-most, most);
      visit(i + 0.5 * (j % 2) + x, j + y);
    }
}

}  // namespace

Patch bent(Patch patch, const std::function<Vector3d(const Vector2d&)>& to) {
  for (Vector3d& p : patch.points) p = to(p.head<2>());
  return patch;
}

std::function<Vector3d(const Vector2d&)> roll(double radius) {
  return [=](const Vector2d& p) {
    return Vector3d(radius * std::sin(p.x() / radius), p.y(), radius * std::cos(p.x() / radius));
  };
}

std::function<Vector3d(const Vector2d&)> waves(double length, double height) {
  return [=](const Vector2d& p) {
    return Vector3d(p.x(), p.y(), height * std::sin(kTurn * p.x() / length) * std::sin(kTurn * p.y() / length));
  };
}

Patch tube(int around, int rows, double jitter, Random& random) {
  Patch patch;
  const double radius = around / kTurn;
  for_ring_nodes(
      around, rows, jitter, random, [&](int j) { return j == 0 || j + 1 == rows; },
      [&](double x, double y) {
        patch.points.emplace_back(radius * std::cos(x / radius), radius * std::sin(x / radius), kRowHeight * y);
      });
  patch.triangles = ring_triangles(around, rows, false);
  return patch;
}

Patch torus(int along, int around, double jitter, Random& random) {
  Patch patch;
  const double large = along / kTurn, small = kRowHeight * around / kTurn;
  for_ring_nodes(
      along, around, jitter, random, [](int) { return false; },
      [&](double x, double y) {
        const double a = x / large, b = kRowHeight * y / small, from_axis = large + small * std::cos(b);
        patch.points.emplace_back(from_axis * std::cos(a), from_axis * std::sin(a), small * std::sin(b));
      });
  patch.triangles = ring_triangles(along, around, true);
  return patch;
}

Patch sphere(int edges, double jitter, Random& random) {
  Patch patch;
  std::map<std::array<int, 3>, Index> nodes;
  const auto node = [&](const std::array<int, 3>& at) {
    const auto [found, is_new] = nodes.try_emplace(at, Index(patch.points.size()));
    if (is_new) {
      const auto moved = [&] { return random.between(-jitter, jitter); };
      patch.points.push_back((Vector3d(at[0], at[1], at[2]) + Vector3d(moved(), moved(), moved())).normalized());
    }
    return found->second;
  };
  for (int side = 0; side < 8; ++side) {
    const std::array<int, 3> sign{side & 1 ? -1 : 1, side & 2 ? -1 : 1, side & 4 ? -1 : 1};
    const auto corner = [&](int x, int y) { return node({sign[0] * x, sign[1] * y, sign[2] * (edges - x - y)}); };
    const auto add = [&](Index a, Index b, Index c) {
      patch.triangles.push_back(sign[0] * sign[1] * sign[2] > 0 ? std::array{a, b, c} : std::array{a, c, b});
    };
    for (int x = 0; x < edges; ++x)
      for (int y = 0; x + y < edges; ++y) {
        add(corner(x, y), corner(x + 1, y), corner(x, y + 1));
        if (x + y + 1 < edges) add(corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1));
      }
  }
  return patch;
}

}  // namespace benchmark
