// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Meshes around one node, drawn from the valences that the nodes around it are to have.

#include <numbers>
#include <string>
#include <vector>

#include "kernel/fixture.hpp"

namespace qmorph::test {

/// Node 0 in the middle, nodes 1, 2, ... around it counter-clockwise with these valences, node 1 a neighbour of node 0,
/// and one layer of quads around them, whose outer side is the boundary. Where `corners` has a 1, the outline of the
/// quads around node 0 has a sharper angle.
inline Mesh surrounded(const std::vector<int>& valences, const std::string& corners = "") {
  const auto size = Index(valences.size());
  const auto at = [&](double place, double radius) {
    const double angle = 2 * std::numbers::pi * place / size;
    return Vec2(radius * std::cos(angle), radius * std::sin(angle));
  };
  std::vector<Vec2> points{{0, 0}};
  Polygons faces;
  for (Index i = 0; i < size; ++i) {
    points.push_back(at(i, corners.empty() || corners[i] == '0' ? 1 : 1.25));
    if (i % 2 == 0) faces.push_back({0, 1 + i, 1 + (i + 1) % size, 1 + (i + 2) % size});
  }
  // Edges that leave the ring outwards; each pair of neighbours bounds a quad outside.
  std::vector<Index> spokes;
  for (Index i = 0; i < size; ++i)
    for (int k = i % 2 == 0 ? 3 : 2; k < valences[i]; ++k) spokes.push_back(i);
  const auto count = Index(spokes.size());
  const auto steps = [&](Index k) { return (spokes[(k + 1) % count] + size - spokes[k % count]) % size; };
  Index start = 0;
  while (steps(start + count - 1) == 2) ++start;
  const auto outer = [&](double place, double radius = 2.5) {
    points.push_back(at(place, radius));
    return Index(points.size() - 1);
  };
  const Index first = outer(spokes[start % count]);
  for (Index k = start, end = first; k < start + count; ++k) {
    const Index i = spokes[k % count], j = spokes[(k + 1) % count];
    const bool is_last = k + 1 == start + count;
    if (steps(k) == 2) {  // both spokes end at one node
      faces.push_back({1 + i, end, 1 + j, 1 + (i + 1) % size});
      continue;
    }
    std::vector<Index> face{1 + i, end};
    if (steps(k) == 0) face.push_back(outer(i + 0.25, 3));
    end = is_last ? first : outer(steps(k) == 0 ? i + 0.5 : j);
    face.push_back(end);
    if (steps(k) == 1) face.push_back(1 + j);
    faces.push_back(face);
  }
  return drawn(points, faces);
}

/// The mesh in a mirror; nodes keep their numbers.
inline Mesh mirror_image(const Mesh& mesh) {
  std::vector<Vec2> points;
  for (Index v = 0; v < mesh.vertex_slots(); ++v) points.emplace_back(-mesh.point(v).x(), mesh.point(v).y());
  Polygons faces = faces_of(mesh);
  for (auto& face : faces) std::reverse(face.begin() + 1, face.end());
  return drawn(points, faces);
}

}  // namespace qmorph::test
