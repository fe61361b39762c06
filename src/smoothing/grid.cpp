// SPDX-License-Identifier: GPL-2.0-or-later
#include "smoothing/grid.hpp"

#include <algorithm>
#include <optional>

namespace qmorph::smoothing {
namespace {

using kernel::Mesh;

struct Grid {
  std::size_t columns, rows;  ///< nodes
  std::vector<Index> nodes;   ///< row by row
  Index at(std::size_t i, std::size_t j) const { return nodes[j * columns + i]; }
};

/// A node where the outline of a grid turns, if all boundary nodes have two or three edges and all others four.
std::optional<Index> find_corner(const Mesh& mesh) {
  std::optional<Index> corner;
  int corners = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f) && mesh.degree(f) != 4) return {};
  for (Index v = 0; v < mesh.vertex_slots(); ++v) {
    if (!mesh.is_live_vertex(v)) continue;
    const Index valence = mesh.valence(v);
    if (mesh.is_boundary(v) ? valence != 2 && valence != 3 : valence != 4 || mesh.is_fixed(v)) return {};
    if (mesh.is_boundary(v) && valence == 2) corner = v, ++corners;
  }
  return corners == 4 ? corner : std::nullopt;
}

std::optional<Grid> find_grid(const Mesh& mesh) {
  const auto corner = find_corner(mesh);
  if (!corner) return {};
  Grid grid{0, 0, {}};
  // The boundary half-edge before the corner, seen from inside, leads along the first row.
  Index h = Mesh::twin(mesh.prev(mesh.out(*corner)));
  for (;;) {
    Index along = h;
    std::size_t columns = 1;
    grid.nodes.push_back(mesh.origin(along));
    for (;; ++columns) {
      grid.nodes.push_back(mesh.target(along));
      const Index last = mesh.next(along);
      if (mesh.face(Mesh::twin(last)) == kNone) break;
      along = mesh.next(Mesh::twin(last));
    }
    grid.columns = columns + 1;
    ++grid.rows;
    const Index above = mesh.next(mesh.next(h));  // points back
    if (mesh.face(Mesh::twin(above)) == kNone) break;
    h = Mesh::twin(above);
  }
  // The last row has no faces above it.
  for (Index along = h;; along = mesh.next(Mesh::twin(mesh.next(along)))) {
    if (along == h) grid.nodes.push_back(mesh.origin(mesh.prev(along)));
    grid.nodes.push_back(mesh.target(mesh.next(along)));
    if (mesh.face(Mesh::twin(mesh.next(along))) == kNone) break;
  }
  ++grid.rows;
  if (grid.nodes.size() != grid.columns * grid.rows) return {};
  return grid;
}

struct Shapes {
  double least = 1, sum = 0;
};
Shapes shapes(const Mesh& mesh) {
  Shapes shapes;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    const double sine = mesh.smallest_sine(f);
    shapes.least = std::min(shapes.least, sine);
    shapes.sum += sine;
  }
  return shapes;
}

}  // namespace

bool snap_to_grid(Mesh& mesh) {
  const auto found = find_grid(mesh);
  if (!found || found->columns < 3 || found->rows < 3) return false;
  const Grid& grid = *found;
  const std::size_t m = grid.columns - 1, n = grid.rows - 1;
  const auto p = [&](std::size_t i, std::size_t j) { return mesh.point(grid.at(i, j)); };
  const Shapes before = shapes(mesh);
  mesh.begin();
  for (std::size_t j = 1; j < n; ++j)
    for (std::size_t i = 1; i < m; ++i) {
      const double s = double(i) / double(m), t = double(j) / double(n);
      const Vec2 corners = (1 - s) * ((1 - t) * p(0, 0) + t * p(0, n)) + s * ((1 - t) * p(m, 0) + t * p(m, n));
      mesh.set_point(grid.at(i, j), (1 - t) * p(i, 0) + t * p(i, n) + (1 - s) * p(0, j) + s * p(m, j) - corners);
    }
  const Shapes after = shapes(mesh);
  bool kept = after.least >= before.least && after.sum >= before.sum;
  for (Index f = 0; kept && f < mesh.face_slots(); ++f) kept = !mesh.is_live_face(f) || mesh.is_valid_face(f);
  kept ? mesh.commit() : mesh.rollback();
  return kept;
}

}  // namespace qmorph::smoothing
