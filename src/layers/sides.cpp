// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/sides.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>

namespace qmorph::layers {
namespace {

/// One side, or (side kNone) a constraint, in the list of its lower node.
struct Entry {
  Index upper, side;
};

/// Entries in the order of their lower nodes; those of node v are first[v] up to first[v + 1].
struct ByLowerNode {
  std::vector<std::size_t> first;
  std::vector<Entry> entries;
};

ByLowerNode sort_by_lower_node(const Patch& patch) {
  ByLowerNode list;
  list.first.assign(patch.points.size() + 2, 0);
  const auto for_each_entry = [&](const auto& visit) {
    Index c = 0;
    for (const auto& [i, j, k] : patch.triangles) visit(i, j, c), visit(j, k, c + 1), visit(k, i, c + 2), c += 3;
    for (const auto& [a, b] : patch.constraints) visit(a, b, kNone);
    for (const auto& q : patch.quads)
      for (std::size_t i = 0; i < 4; ++i) visit(q[i], q[(i + 1) % 4], kNone);
  };
  for_each_entry([&](Index a, Index b, Index) { ++list.first[std::min(a, b) + 2]; });
  for (std::size_t v = 2; v < list.first.size(); ++v) list.first[v] += list.first[v - 1];
  list.entries.resize(list.first.back());
  for_each_entry([&](Index a, Index b, Index c) {
    list.entries[list.first[std::min(a, b) + 1]++] = {std::max(a, b), c};
  });
  return list;
}

bool is_less(const Entry& a, const Entry& b) { return a.upper != b.upper ? a.upper < b.upper : a.side < b.side; }

/// By insertion where they are few, as nearly everywhere.
void sort(std::span<Entry> entries) {
  constexpr std::size_t kFew = 16;
  if (entries.size() > kFew) return std::sort(entries.begin(), entries.end(), is_less);
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const Entry entry = entries[i];
    std::size_t k = i;
    for (; k > 0 && is_less(entry, entries[k - 1]); --k) entries[k] = entries[k - 1];
    entries[k] = entry;
  }
}

}  // namespace

Sides::Sides(const Patch& patch, double crease_angle)
    : patch_(patch), sharp_cosine_(std::cos(crease_angle)), opposite_(3 * patch.triangles.size(), kNone) {
  ByLowerNode list = sort_by_lower_node(patch);
  for (std::size_t v = 0; v < patch.points.size(); ++v) {
    sort(std::span(list.entries).subspan(list.first[v], list.first[v + 1] - list.first[v]));
    for (std::size_t i = list.first[v]; i < list.first[v + 1];) {
      std::size_t end = i + 1;
      while (end < list.first[v + 1] && list.entries[end].upper == list.entries[i].upper) ++end;
      const Index a = list.entries[i].side, b = list.entries[end - 1].side;
      if (end - i == 2 && b != kNone && from(a) == to(b)) opposite_[a] = b, opposite_[b] = a;
      i = end;
    }
  }
}

bool Sides::turns_sharply(Index c) const {
  const auto normal = [&](Index t) {
    const Eigen::Vector3d& a = point(from(3 * t));
    return Eigen::Vector3d((point(from(3 * t + 1)) - a).cross(point(from(3 * t + 2)) - a));
  };
  const Eigen::Vector3d one = normal(c / 3), other = normal(opposite(c) / 3);
  return one.dot(other) < sharp_cosine_ * one.norm() * other.norm();
}

Index Sides::next_wall(Index c) const {
  for (c = next(c); !is_wall(c);) c = next(opposite(c));
  return c;
}

Index Sides::previous_wall(Index c) const {
  for (c = previous(c); !is_wall(c);) c = previous(opposite(c));
  return c;
}

}  // namespace qmorph::layers
