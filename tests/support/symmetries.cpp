// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/symmetries.hpp"

#include <algorithm>

namespace qmorph::test {
namespace {

using Place = std::array<double, 3>;
using Element = std::vector<Place>;

Place placed(const Eigen::Matrix3d& turn, const Eigen::Vector3d& point) {
  const Eigen::Vector3d p = turn * point;
  return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};  // -0 is 0
}

template <class Corners>
void add(Elements& elements, const std::vector<Eigen::Vector3d>& points, const std::vector<Corners>& rows,
         const Eigen::Matrix3d& turn) {
  for (const Corners& row : rows) {
    Element element;
    for (Index v : row) element.push_back(placed(turn, points[v]));
    std::sort(element.begin(), element.end());
    elements.push_back(element);
  }
}

template <class Surface>
Elements sorted_elements(const Surface& surface, const Eigen::Matrix3d& turn) {
  Elements elements;
  add(elements, surface.points, surface.triangles, turn);
  add(elements, surface.points, surface.quads, turn);
  std::sort(elements.begin(), elements.end());
  return elements;
}

}  // namespace

Eigen::Matrix3d symmetry(std::size_t number) {
  std::array<int, 3> axis{0, 1, 2};
  for (std::size_t i = number / 8; i > 0; --i) std::next_permutation(axis.begin(), axis.end());
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) matrix(i, axis[std::size_t(i)]) = number >> i & 1 ? -1 : 1;
  return matrix;
}

Elements elements_of(const Patch& patch, const Eigen::Matrix3d& turn) { return sorted_elements(patch, turn); }
Elements elements_of(const QuadMesh& mesh, const Eigen::Matrix3d& turn) { return sorted_elements(mesh, turn); }

bool is_symmetric(Patch patch) {
  std::size_t trivial = 1;
  for (int i = 0; i < 3; ++i) {  // where a flat one lies across does not matter
    if (!std::all_of(patch.points.begin(), patch.points.end(),
                     [&](const Eigen::Vector3d& p) { return p[i] == patch.points[0][i]; }))
      continue;
    for (auto& p : patch.points) p[i] = 0;
    trivial *= 2;
  }
  const Elements as_it_is = elements_of(patch);
  std::size_t same = 0;
  for (std::size_t i = 0; i < kSymmetries; ++i) same += elements_of(patch, symmetry(i)) == as_it_is;
  return same > trivial;
}

}  // namespace qmorph::test
