// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/z_curve.hpp"

#include <algorithm>
#include <array>
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

/// Sorts the keys, whose lower 32 bits ascend: a counting sort for each digit of the upper ones, if there are many.
void sort_by_place(std::vector<std::uint64_t>& keys) {
  constexpr int kDigit = 11;  // bits
  constexpr std::size_t kFew = 512;
  if (keys.size() <= kFew) return std::sort(keys.begin(), keys.end());
  std::vector<std::uint64_t> sorted(keys.size());
  for (int shift = 32; shift < 64; shift += kDigit) {
    const auto digit = [&](std::uint64_t key) { return (key >> shift) & ((1u << kDigit) - 1); };
    std::array<std::size_t, (1u << kDigit) + 1> start{};
    for (std::uint64_t key : keys) ++start[digit(key) + 1];
    for (std::size_t d = 0; d + 1 < start.size(); ++d) start[d + 1] += start[d];
    for (std::uint64_t key : keys) sorted[start[digit(key)]++] = key;
    keys.swap(sorted);
  }
}

/// Those that have one place.
void sort_within_places(std::vector<std::uint64_t>& keys, const std::function<bool(Index, Index)>& before) {
  for (auto first = keys.begin(), last = first; first != keys.end(); first = last) {
    while (last != keys.end() && *last >> 32 == *first >> 32) ++last;
    if (last - first > 1)
      std::stable_sort(first, last, [&](std::uint64_t a, std::uint64_t b) { return before(Index(a), Index(b)); });
  }
}

}  // namespace

std::vector<Index> along_z_curve(const std::vector<Vec2>& points, const std::function<bool(Index, Index)>& before) {
  constexpr double kCells = 65535;  // each way
  if (points.empty()) return {};
  Vec2 low = points[0], high = low;
  for (const Vec2& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double width = (high - low).maxCoeff(), scale = width > 0 ? kCells / width : 0;
  std::vector<std::uint64_t> keys;  // the place on the curve, then the number
  keys.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 cell = (points[i] - low) * scale;
    const std::uint64_t place = spread(std::uint64_t(cell.x())) | spread(std::uint64_t(cell.y())) << 1;
    keys.push_back(place << 32 | i);
  }
  sort_by_place(keys);
  if (before) sort_within_places(keys, before);
  std::vector<Index> order;
  order.reserve(keys.size());
  for (std::uint64_t key : keys) order.push_back(Index(key));
  return order;
}

}  // namespace qmorph
