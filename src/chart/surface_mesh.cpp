// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/surface_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "chart/local_numbers.hpp"
#include "kernel/sort_unique.hpp"
#include "space/corners.hpp"

namespace qmorph::chart {
namespace {

double smaller_half(const SurfaceMesh& mesh, const Face& q, int k) {
  const auto half = [&](Index a, Index b, Index c) {
    return Eigen::Vector3d((mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]));
  };
  const Eigen::Vector3d first = half(q[k], q[k + 1], q[k + 2]), second = half(q[k], q[k + 2], q[(k + 3) % 4]);
  const double size = std::min(first.norm(), second.norm());
  return first.dot(second) < 0 ? -size : size;
}

}  // namespace

double own_sine(const SurfaceMesh& mesh, const Face& face) {
  const auto at = [&](Index i) -> const Eigen::Vector3d& { return mesh.points[face[i]]; };
  return degree(face) == 4 ? space::own_sine<4>({at(0), at(1), at(2), at(3)})
                           : space::own_sine<3>({at(0), at(1), at(2)});
}

double smallest_own_sine(const SurfaceMesh& mesh) {
  double least = 1;
  for (const Face& face : mesh.faces) least = std::min(least, own_sine(mesh, face));
  return least;
}

std::vector<Index> opposite_sides(const SurfaceMesh& mesh) {
  struct Entry {
    Index upper, side, following;
  };
  std::vector<Index> opposite(4 * mesh.faces.size(), kNone), first(mesh.points.size(), kNone);
  std::vector<Entry> waiting;  // sides whose edge has no other yet, in chains by the lower node; others are taken out
  waiting.reserve(2 * mesh.faces.size());
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    const Face& face = mesh.faces[f];
    const Index corners = degree(face);
    for (Index i = 0; i < corners; ++i) {
      const Index side = 4 * f + i, from = face[i], to = face[i + 1 == corners ? 0 : i + 1];
      if (mesh.open[side]) continue;
      const auto [low, high] = std::minmax(from, to);
      Index* link = &first[low];
      for (; *link != kNone; link = &waiting[*link].following) {
        const Entry& entry = waiting[*link];
        if (entry.upper != high || mesh.faces[entry.side / 4][entry.side % 4] == from) continue;  // runs the same way
        opposite[side] = entry.side, opposite[entry.side] = side;
        *link = entry.following;
        break;
      }
      if (opposite[side] != kNone) continue;
      waiting.push_back({high, side, first[low]});
      first[low] = Index(waiting.size() - 1);
    }
  }
  return opposite;
}

Piece::Piece(const SurfaceMesh& mesh, const std::vector<Index>& opposite, const std::vector<bool>& is_cut,
             const std::vector<Index>& rows)
    : row(rows), open(4 * rows.size(), false) {
  const LocalNumbers local(rows, mesh.faces.size());
  for (std::vector<Index>* by_point : {&vertex, &on, &node}) by_point->reserve(rows.size());
  points.reserve(rows.size()), fixed.reserve(rows.size());
  near.reserve(rows.size()), first_half.reserve(rows.size()), halves.reserve(2 * rows.size());
  const auto across = [&](Index side) {  // a side of the mesh inside of the piece, or kNone
    const Index other = opposite[side];
    return other == kNone || local[other / 4] == kNone || (!is_cut.empty() && is_cut[side]) ? kNone : other;
  };
  const auto next = [&](Index side) { return side - side % 4 + next_corner(mesh.faces[side / 4], side % 4); };
  const auto previous = [&](Index side) { return side % 4 == 0 ? side + degree(mesh.faces[side / 4]) - 1 : side - 1; };
  faces.assign(rows.size(), {kNone, kNone, kNone, kNone});
  std::vector<Index> corner(4 * rows.size(), kNone);
  const auto give = [&](Index side, Index number) { corner[4 * local[side / 4] + side % 4] = number; };
  for (Index k = 0; k < rows.size(); ++k) {
    const Face& face = mesh.faces[rows[k]];
    near.push_back(mesh.near[rows[k]]);
    for (Index i = 0; i < degree(face); ++i) {
      const Index side = 4 * rows[k] + i;
      if (across(side) == kNone) {
        open[4 * k + i] = true, ++boundary_sides;
        const std::pair<Index, Index> edge = std::minmax(face[i], face[next_corner(face, i)]);
        if (!mesh.open[side]) seams.push_back(edge);
      }
      if (corner[4 * k + i] == kNone) {  // a new fan
        const Index number = Index(points.size());
        points.push_back(mesh.points[face[i]]);
        vertex.push_back(face[i]);
        on.push_back(mesh.on[face[i]]);
        fixed.push_back(mesh.fixed[face[i]]);
        node.push_back(mesh.node[face[i]]);
        give(side, number);
        bool closed = false;
        for (Index e = across(side); e != kNone && !closed; e = across(e)) {
          e = next(e);
          closed = e == side;
          give(e, number);
        }
        if (!closed)
          for (Index e = across(previous(side)); e != kNone; e = across(previous(e))) give(e, number);
      }
      faces[k][i] = corner[4 * k + i];
    }
  }
  sort_unique(seams);

  for (Index k = 0; k < rows.size(); ++k) {
    const Face& q = faces[k];
    first_half.push_back(Index(halves.size()));
    if (degree(q) == 3) {
      halves.push_back({q[0], q[1], q[2]});
      continue;
    }
    const Index d = smaller_half(mesh, mesh.faces[rows[k]], 1) > smaller_half(mesh, mesh.faces[rows[k]], 0) ? 1 : 0;
    halves.push_back({q[d], q[d + 1], q[d + 2]});
    halves.push_back({q[d], q[d + 2], q[(d + 3) % 4]});
  }
}

std::vector<space::Background::Edge> Piece::barriers() const {
  std::vector<space::Background::Edge> edges;
  for (Index side = 0; side < open.size(); ++side)
    if (open[side])
      edges.push_back({faces[side / 4][side % 4], faces[side / 4][next_corner(faces[side / 4], side % 4)]});
  return edges;
}

Region Piece::region(const std::vector<Vec2>& flat) const {
  Region region;
  region.points = flat;
  for (Index v = 0; v < points.size(); ++v) {
    region.node.push_back(v);
    if (fixed[v]) region.fixed.push_back(v);
  }
  region.boundary_sides = boundary_sides;
  if (halves.size() > faces.size()) return region;
  region.triangles = halves;
  region.row = row;
  for (Index k = 0; k < faces.size(); ++k)
    for (Index i = 0; i < 3; ++i) region.open.push_back(open[4 * k + i]);
  return region;
}

kernel::Mesh Piece::mesh(const std::vector<Vec2>& flat) const {
  kernel::Mesh mesh(flat, faces, open);
  for (Index v = 0; v < points.size(); ++v)
    if (fixed[v]) mesh.set_fixed(v);
  return mesh;
}

}  // namespace qmorph::chart
