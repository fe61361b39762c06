#include "engine/spatial_order.hpp"

#include <algorithm>
#include <cstdint>

namespace qmorph {
namespace {

/// The 16 bits of `x` at the even places.
std::uint64_t spread(std::uint64_t x) {
  x = (x | (x << 8)) & 0x00ff00ff;
  x = (x | (x << 4)) & 0x0f0f0f0f;
  x = (x | (x << 2)) & 0x33333333;
  return (x | (x << 1)) & 0x55555555;
}

}  // namespace

std::vector<Index> spatial_order(const std::vector<std::array<Index, 3>>& triangles, const std::vector<Vec2>& points) {
  constexpr double kCells = 65535;  // each way
  if (triangles.empty()) return {};
  const auto middle = [&](const std::array<Index, 3>& t) -> Vec2 {
    return (points[t[0]] + points[t[1]] + points[t[2]]) / 3;
  };
  Vec2 low = middle(triangles[0]), high = low;
  for (const auto& t : triangles) {
    const Vec2 p = middle(t);
    low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  const double width = (high - low).maxCoeff(), scale = width > 0 ? kCells / width : 0;
  std::vector<std::uint64_t> keys;  // the place on the curve, then the number
  keys.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Vec2 cell = (middle(triangles[t]) - low) * scale;
    const std::uint64_t place = spread(std::uint64_t(cell.x())) | spread(std::uint64_t(cell.y())) << 1;
    keys.push_back(place << 32 | t);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Index> order;
  order.reserve(keys.size());
  for (std::uint64_t key : keys) order.push_back(Index(key));
  return order;
}

}  // namespace qmorph
