// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/filling.hpp"

#include <algorithm>

namespace qmorph::cleanup {
namespace {

using kernel::Mesh;

Index ahead(const Mesh& mesh, Index h, int steps) {
  while (steps-- > 0) h = mesh.next(h);
  return h;
}

/// Nodes along `steps` half-edges from h on: steps + 1 of them.
std::vector<Vec2> points_along(const Mesh& mesh, Index h, int steps) {
  std::vector<Vec2> points;
  points.reserve(std::size_t(steps) + 1);
  points.push_back(mesh.point(mesh.origin(h)));
  for (; steps > 0; --steps, h = mesh.next(h)) points.push_back(mesh.point(mesh.target(h)));
  return points;
}

class Filler {
 public:
  Filler(Mesh& mesh, std::vector<Index>& nodes) : mesh_(mesh), nodes_(nodes) {}

  /// The face of h, whose sides from h on are a, b, a and b edges long, becomes a grid with the points of a Coons
  /// patch.
  bool grid(Index h, int a, int b) {
    const std::vector<Vec2> bottom = points_along(mesh_, h, a);
    const std::vector<Vec2> right = points_along(mesh_, ahead(mesh_, h, a), b);
    std::vector<Vec2> top = points_along(mesh_, ahead(mesh_, h, a + b), a);
    std::vector<Vec2> left = points_along(mesh_, ahead(mesh_, h, 2 * a + b), b);
    std::reverse(top.begin(), top.end());
    std::reverse(left.begin(), left.end());
    for (int j = 1; j < b; ++j) {
      const double t = double(j) / b;
      std::vector<Vec2> row;
      for (int i = 1; i < a; ++i) {
        const double s = double(i) / a;
        const Vec2 corners = (1 - s) * ((1 - t) * bottom[0] + t * top[0]) + s * ((1 - t) * bottom[a] + t * top[a]);
        row.push_back((1 - t) * bottom[i] + t * top[i] + (1 - s) * left[j] + s * right[j] - corners);
      }
      // From the left side to the right, one edge above the bottom.
      const Index rail = path(mesh_.prev(h), ahead(mesh_, h, a + 1), row);
      if (rail == kNone || !cells(h, a)) return false;
      h = rail;
    }
    return cells(h, a);
  }

  /// New edges from origin(g) to origin(h) in the face of both, through these points. Returns the first half-edge
  /// from origin(g) on; it lies in the part of the face that starts with h.
  Index path(Index g, Index h, const std::vector<Vec2>& points) {
    if (points.empty() && mesh_.find(mesh_.origin(g), mesh_.origin(h)) != kNone) return kNone;
    Index e = mesh_.split_face(g, h);
    const Index first = e;
    for (const Vec2& p : points) {
      nodes_.push_back(mesh_.split_edge(e, p));
      e = mesh_.next(e);
    }
    return first;
  }

 private:
  /// A strip one edge high becomes quads.
  bool cells(Index h, int count) {
    for (; count > 1; --count) {
      // The cell is the new face: the cost is that of its sides, not of the strip's.
      const Index edge = path(mesh_.prev(mesh_.prev(h)), mesh_.next(h), {});
      if (edge == kNone) return false;
      h = mesh_.next(edge);
    }
    return true;
  }

  Mesh& mesh_;
  std::vector<Index>& nodes_;
};

std::vector<Vec2> between(const Vec2& p, const Vec2& q, int edges) {
  std::vector<Vec2> points;
  for (int i = 1; i < edges; ++i) points.push_back(p + (double(i) / edges) * (q - p));
  return points;
}

/// Three or five grids around a new node, or around one of the ring where a spoke has no length.
bool fill_star(Mesh& mesh, const std::vector<Index>& ring, const Filling& filling, std::vector<Index>& nodes) {
  Filler filler(mesh, nodes);
  const int n = int(ring.size()), k = filling.corners;
  const auto before = [&](int i) { return (i + k - 1) % k; };
  const auto end = [&](int i) { return ring[(filling.corner[i] + filling.spokes[before(i)]) % n]; };  // of a spoke
  const auto end_point = [&](int i) { return mesh.point(mesh.origin(end(i))); };
  const auto zero = std::find(filling.spokes.begin(), filling.spokes.begin() + k, 0) - filling.spokes.begin();
  const bool is_inside = zero == k;
  Vec2 centre = Vec2::Zero();
  int at = 0, spokes_to_draw = k - 2;
  Index from_centre = kNone;
  if (is_inside) {
    for (int i = 0; i < k; ++i) centre += end_point(i) / k;
    // The first two spokes are one path through the centre.
    std::vector<Vec2> points = between(end_point(0), centre, filling.spokes[0]);
    points.push_back(centre);
    for (const Vec2& p : between(centre, end_point(1), filling.spokes[1])) points.push_back(p);
    from_centre = filler.path(end(0), end(1), points);
    if (from_centre == kNone) return false;
    from_centre = ahead(mesh, from_centre, filling.spokes[0]);
  } else {
    at = int(zero);
    from_centre = end(at);
    centre = end_point(at);
    spokes_to_draw = k - 3;  // those on both sides run along the ring
  }
  for (int i = 0; i < spokes_to_draw; ++i) {
    const int spoke = (at + 2 + i) % k;
    from_centre = filler.path(from_centre, end(spoke), between(centre, end_point(spoke), filling.spokes[spoke]));
    if (from_centre == kNone) return false;
  }
  for (int i = 0; i < k; ++i) {
    const int across = filling.spokes[before(i)], along = filling.spokes[i];
    if (across > 0 && along > 0 && !filler.grid(ring[filling.corner[i]], across, along)) return false;
  }
  return true;
}

}  // namespace

std::optional<Filling> filling_between(std::span<const int> corners, int n) {
  const int k = int(corners.size());
  Filling filling;
  filling.corners = k;
  std::array<int, 5> side{};
  for (int i = 0; i < k; ++i) {
    filling.corner[i] = corners[i];
    side[i] = i + 1 < k ? corners[i + 1] - corners[i] : corners[0] + n - corners[i];
  }
  if (k == 4) {
    if (side[0] != side[2] || side[1] != side[3]) return {};
    return filling;
  }
  // side[i] = spokes[i - 1] + spokes[i + 1]: an alternating sum round the ring in steps of two.
  for (int i = 0; i < k; ++i) {
    int sum = 0, sign = 1;
    for (int j = 0, at = (i + 1) % k; j < k; ++j, at = (at + 2) % k, sign = -sign) sum += sign * side[at];
    if (sum < 2 || sum % 2 != 0) return {};
    filling.spokes[i] = sum / 2;
  }
  return filling;
}

int quads_of(const Filling& filling, int n) {
  const int k = filling.corners;
  if (k == 4) {
    const int side = filling.corner[1] - filling.corner[0];
    return side * (n / 2 - side);
  }
  int count = 0;
  for (int i = 0; i < k; ++i) count += filling.spokes[i] * filling.spokes[(i + 1) % k];
  return count;
}

bool fill(kernel::Mesh& mesh, const std::vector<Index>& ring, const std::vector<Index>& faces, const Filling& filling,
          std::vector<Index>& nodes) {
  for (Index h : ring) nodes.push_back(mesh.origin(h));
  mesh.make_face(ring, faces);
  if (filling.corners != 4) return fill_star(mesh, ring, filling, nodes);
  return Filler(mesh, nodes)
      .grid(ring[filling.corner[0]], filling.corner[1] - filling.corner[0], filling.corner[2] - filling.corner[1]);
}

bool fill(kernel::Mesh& mesh, const std::vector<Index>& ring, const std::vector<Index>& faces,
          const PairFilling& filling, std::vector<Index>& nodes) {
  for (Index h : ring) nodes.push_back(mesh.origin(h));
  mesh.make_face(ring, faces);
  const int n = int(ring.size());
  const auto at = [&](int place) { return ring[(place + n) % n]; };
  const Index from = at(filling.corner + filling.ahead), to = at(filling.corner - filling.back);
  std::vector<Vec2> points = between(mesh.point(mesh.origin(from)), filling.bend, filling.triangle.spokes[1]);
  points.push_back(filling.bend);
  for (const Vec2& p : between(filling.bend, mesh.point(mesh.origin(to)), filling.triangle.spokes[0]))
    points.push_back(p);
  Index cut = Filler(mesh, nodes).path(from, to, points);
  if (cut == kNone) return false;
  std::vector<Index> triangle, pentagon;
  for (int i = -filling.back; i < filling.ahead; ++i) triangle.push_back(at(filling.corner + i));
  for (int i = filling.ahead; i < n - filling.back; ++i) pentagon.push_back(at(filling.corner + i));
  for (int i = 0; i < filling.cut(); ++i, cut = mesh.next(cut)) triangle.push_back(cut);
  for (int i = 0; i < filling.cut(); ++i) pentagon.push_back(Mesh::twin(triangle[triangle.size() - 1 - i]));
  return fill_star(mesh, triangle, filling.triangle, nodes) && fill_star(mesh, pentagon, filling.pentagon, nodes);
}

}  // namespace qmorph::cleanup
