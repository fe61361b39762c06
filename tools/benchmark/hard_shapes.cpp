// SPDX-License-Identifier: GPL-2.0-or-later
#include "hard_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace benchmark {
namespace {

constexpr double kPi = std::numbers::pi;

Vector2d on_circle(double share, double radius) {
  return radius * Vector2d(std::cos(2 * kPi * share), std::sin(2 * kPi * share));
}

}  // namespace

Patch scaled(Patch patch, double x, double y) {
  map_points(patch, [&](const Vector2d& p) { return Vector2d(x * p.x(), y * p.y()); });
  return patch;
}

Patch with_lines(Patch patch, double share, Random& random) {
  for (const InnerEdge& edge : inner_edges(patch))
    if (random.chance(share)) patch.constraints.push_back({edge.a, edge.b});
  return patch;
}

Patch with_fixed_nodes(Patch patch, double share, Random& random) {
  for (const Index v : inner_nodes(patch))
    if (random.chance(share)) patch.fixed.push_back(v);
  return patch;
}

std::vector<Vector2d> cloud(int count, Random& random) {
  std::vector<Vector2d> points;
  for (int i = 0; i < count; ++i) {  // in rows, to and fro, so that each is near the one before
    const double y = std::floor(std::sqrt(double(i)));
    points.emplace_back(random.between(0, 1), random.between(y, y + 1));
  }
  const double rows = std::floor(std::sqrt(double(count)));
  for (Vector2d& p : points) p.y() /= rows;
  return points;
}

// --- stretched
// ----------------------------------------------------------------------------------------------------------

Patch uneven_stretch(int columns, int rows) {
  Random random(3);
  Patch patch = lattice(columns, rows, 0.2, random);
  map_points(patch, [=](const Vector2d& p) {
    const double x = p.x() / columns, y = p.y() / rows;
    return Vector2d(std::expm1(6 * x), std::expm1(6 * y));
  });
  return with_lines(std::move(patch), 0.2, random);
}

Patch boundary_layer(int around, int rows) {
  Patch patch = grid(around, rows);
  const auto edges = Index(around);
  for (auto& t : patch.triangles)
    for (Index& v : t)
      if (v % (edges + 1) == edges) v -= edges;  // a ring
  keep_triangles(patch, [](const Vector2d&) { return true; });
  const double growth = 13.8 / rows;
  map_points(patch, [=](const Vector2d& p) {
    return on_circle(-p.x() / around, 1 + 1e-6 * std::expm1(growth * p.y()) / growth);
  });
  return patch;
}

// --- fans
// ---------------------------------------------------------------------------------------------------------------

Patch fan(Index count, bool inside) {
  Patch patch;
  patch.points.emplace_back(inside ? 0 : 0.5, 0, 0);
  const Index ring = inside ? count : count + 1;
  for (Index i = 0; i < ring; ++i) {
    const Vector2d p = on_circle(double(i) / (inside ? count : 2 * count), 1);
    patch.points.emplace_back(p.x(), p.y(), 0);
  }
  for (Index i = 0; i < count; ++i) patch.triangles.push_back({0, 1 + i, 1 + (i + 1) % ring});
  return patch;
}

Patch many_fans(int each_way, int edges) {
  const int n = each_way * edges;
  Patch patch = grid(n, n);
  std::vector<Vector2d> points;
  const auto place = [&](int i, int j) { return Index(j * (n + 1) + i); };
  patch.triangles.clear();
  for (int i = 0; i < each_way; ++i)
    for (int j = 0; j < each_way; ++j) {
      const int x = i * edges, y = j * edges;
      const Index middle = place(x + edges / 2, y + edges / 2);
      for (int k = 0; k < edges; ++k) {
        patch.triangles.push_back({middle, place(x + k, y), place(x + k + 1, y)});
        patch.triangles.push_back({middle, place(x + edges, y + k), place(x + edges, y + k + 1)});
        patch.triangles.push_back({middle, place(x + k + 1, y + edges), place(x + k, y + edges)});
        patch.triangles.push_back({middle, place(x, y + k + 1), place(x, y + k)});
      }
    }
  keep_triangles(patch, [](const Vector2d&) { return true; });
  return patch;
}

// --- lines
// --------------------------------------------------------------------------------------------------------------

Patch close_lines(double gap, double size) {
  std::vector<double> heights;
  for (double y = gap / 2, step = gap; y < 0.5; step = std::min(size, 1.15 * step), y += step) heights.push_back(y);
  std::vector<std::vector<Vector2d>> rows;
  const auto edges_at = [&](std::size_t i) {
    return int(std::ceil(1 / (i == 0 ? gap : std::min(size, heights[i] - heights[i - 1]))));
  };
  for (std::size_t i = heights.size(); i-- > 0;) rows.push_back(row(-heights[i], 1, edges_at(i)));
  for (std::size_t i = 0; i < heights.size(); ++i) rows.push_back(row(heights[i], 1, edges_at(i)));
  Patch patch = zip(rows);
  Index node = 0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (r + 1 == heights.size() || r == heights.size())
      for (Index i = 0; i + 1 < rows[r].size(); ++i) patch.constraints.push_back({node + i, node + i + 1});
    node += Index(rows[r].size());
  }
  return patch;
}

std::vector<Patch> scattered_surfaces(Patch patch, Index surfaces, Random& random) {
  std::vector<Index> part_of(patch.triangles.size());
  for (Index& part : part_of) part = Index(random.below(surfaces));
  return split(patch, part_of, surfaces);
}

std::vector<Patch> ragged_pieces(const Patch& patch, double width, Random& random) {
  double most_x = 0, most_y = 0;
  for (const auto& p : patch.points) most_x = std::max(most_x, p.x()), most_y = std::max(most_y, p.y());
  const auto columns = Index(most_x / width) + 1, rows = Index(most_y / width) + 1;
  std::vector<Vector2d> seeds;
  for (Index r = 0; r < rows; ++r)
    for (Index c = 0; c < columns; ++c)
      seeds.push_back(width * Vector2d(c + random.between(0, 1), r + random.between(0, 1)));
  std::vector<Index> part_of;
  for (const auto& t : patch.triangles) {
    const Vector2d p = ((patch.points[t[0]] + patch.points[t[1]] + patch.points[t[2]]) / 3).head<2>();
    const auto x = Index(p.x() / width), y = Index(p.y() / width);
    Index nearest = y * columns + x;
    for (Index r = std::max(y, 1u) - 1; r < std::min(y + 2, rows); ++r)
      for (Index c = std::max(x, 1u) - 1; c < std::min(x + 2, columns); ++c)
        if ((seeds[r * columns + c] - p).norm() < (seeds[nearest] - p).norm()) nearest = r * columns + c;
    part_of.push_back(nearest);
  }
  return split(patch, part_of, Index(seeds.size()));
}

// --- no inner nodes
// ------------------------------------------------------------------------------------------------------

Patch cut_polygon(Index count, Random& random, double evenness) {
  Patch patch;
  for (Index i = 0; i < count; ++i) {
    const Vector2d p = on_circle(double(i) / count, 1);
    patch.points.emplace_back(p.x(), p.y(), 0);
  }
  std::vector<std::pair<Index, Index>> open{{0, count - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    if (last - first < 2) continue;
    const double inside = double(last - first - 1);
    const auto middle = Index(first + 1 + Index(inside * random.between(0.5 * evenness, 1 - 0.5 * evenness)));
    patch.triangles.push_back({first, middle, last});
    open.emplace_back(first, middle), open.emplace_back(middle, last);
  }
  return patch;
}

Patch strip(int edges, double length_over_height, Random& random) {
  std::vector<std::vector<Vector2d>> rows{row(0, edges, edges), row(1 / length_over_height, edges, edges)};
  for (std::size_t i = 1; i + 1 < rows[1].size(); ++i) rows[1][i].x() += random.between(-0.4, 0.4);
  return zip(rows);
}

// --- outlines
// ------------------------------------------------------------------------------------------------------------

Patch spikes(int columns, int rows, double length) {
  Random random(5);
  Patch patch = lattice(columns, rows, 0.1, random);
  std::set<std::pair<Index, Index>> inner;
  for (const InnerEdge& e : inner_edges(patch)) inner.insert({e.a, e.b}), inner.insert({e.b, e.a});
  const auto triangles = patch.triangles;
  for (const auto& t : triangles)
    for (int i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      if (inner.contains({a, b})) continue;
      const Eigen::Vector3d along = patch.points[b] - patch.points[a], out(along.y(), -along.x(), 0);
      const Eigen::Vector3d tip = (patch.points[a] + patch.points[b]) / 2 + length * random.between(0.5, 1) * out;
      patch.triangles.push_back({b, a, Index(patch.points.size())});
      patch.points.push_back(tip);
    }
  return patch;
}

Patch notches(int columns) {
  Random random(7);
  Patch patch = lattice(columns, 8, 0.1, random);
  const double height = 8 * std::sqrt(3.0) / 2;
  keep_triangles(patch, [&](const Vector2d& p) {
    const bool at_side = p.y() < 0.5 || p.y() > height - 0.5;
    const double x = p.x() - 2 * std::floor(p.x() / 2);
    return !(at_side && std::abs(x - 0.5) < 0.3 && (p.y() < 0.35 || p.y() > height - 0.35));
  });
  return patch;
}

Patch holes(int columns, int rows, int period) {
  Random random(8);
  Patch patch = lattice(columns, rows, 0.1, random);
  const double height = std::sqrt(3.0) / 2;
  keep_triangles(patch, [&](const Vector2d& p) {
    const double y = std::round(p.y() / (period * height)) * period * height, x = std::round(p.x() / period) * period;
    return (p - Vector2d(x, y)).norm() > 0.75;
  });
  return patch;
}

Patch maze(int columns, int rows, double share, Random& random) {
  Patch patch = lattice(columns, rows, 0.1, random);
  keep_triangles(patch, [&](const Vector2d&) { return random.chance(share); });
  return patch;
}

Patch spiral(double width, int turns) {
  Random random(9);
  const int n = 8 * turns;
  Patch patch = lattice(n, n, 0.15, random);
  const Vector2d middle(n / 2.0, n * std::sqrt(3.0) / 4);
  keep_triangles(patch, [&](const Vector2d& p) {
    const Vector2d d = p - middle;
    const double turn = std::atan2(d.y(), d.x()) / (2 * kPi), radius = d.norm() / 4 - turn;
    return d.norm() < n * 0.42 && radius - std::floor(radius) < width;
  });
  return patch;
}

Patch star(int points, int count) {
  Random random(10);
  Patch patch = delaunay(cloud(count, random));
  keep_triangles(patch, [&](const Vector2d& p) {
    const Vector2d d = 2 * p - Vector2d(1, 1);
    const double turn = std::atan2(d.y(), d.x()) / (2 * kPi) * points;
    return d.norm() < 0.3 + 0.6 * std::abs(2 * (turn - std::floor(turn)) - 1);
  });
  return patch;
}

Patch comb(int teeth) {
  std::vector<Vector2d> low, high;
  for (int i = 0; i <= 2 * teeth; ++i) low.emplace_back(i, 0), high.emplace_back(i, teeth);
  Patch patch = zip({low, high});
  Patch back = grid(2 * teeth, 4);
  keep_triangles(patch, [](const Vector2d& p) { return std::fmod(p.x(), 2) < 1; });
  // Both have the nodes on the line between them.
  map_points(back, [](const Vector2d& p) { return Vector2d(p.x(), p.y() - 4); });
  std::vector<Index> place;
  for (const auto& p : patch.points) {
    if (p.y() > 0) {
      place.push_back(Index(back.points.size()));
      back.points.push_back(p);
    } else {
      place.push_back(Index(4 * (2 * teeth + 1) + std::lround(p.x())));
    }
  }
  for (auto t : patch.triangles) {
    for (Index& v : t) v = place[v];
    back.triangles.push_back(t);
  }
  return back;
}

Patch graded(int columns, int rows, double ratio) {
  Random random(12);
  Patch patch = lattice(columns, rows, 0.15, random);
  const double scale = std::log(ratio) / columns;
  map_points(patch, [&](const Vector2d& p) {
    return Vector2d(std::exp(scale * p.x()) * on_circle(scale * p.y() / (2 * kPi), 1));
  });
  return patch;
}

Patch turned(int columns, int rows) {
  Random random(13);
  Patch patch = holes(columns, rows, 20);
  constexpr double kFlattest = 1e-3;
  for (int i = 0; i < 6; ++i) turn_edges(patch, 0.5, kFlattest, random);
  return patch;
}

Patch mixed(int columns, int rows, double share) {
  Random random(14);
  Patch patch = lattice(columns, rows, 0.15, random);
  std::vector<char> gone(patch.triangles.size(), 0);
  for (const InnerEdge& e : inner_edges(patch)) {
    if (gone[e.left_triangle] || gone[e.right_triangle] || !random.chance(share)) continue;
    const auto corner = [&](Index before, Index at, Index after) {
      return (patch.points[after] - patch.points[at]).cross(patch.points[before] - patch.points[at]).z();
    };
    if (corner(e.left, e.a, e.right) < 0.2 || corner(e.right, e.b, e.left) < 0.2) continue;
    gone[e.left_triangle] = gone[e.right_triangle] = 1;
    patch.quads.push_back({e.a, e.right, e.b, e.left});
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < patch.triangles.size(); ++t)
    if (!gone[t]) patch.triangles[kept++] = patch.triangles[t];
  patch.triangles.resize(kept);
  return patch;
}

}  // namespace benchmark
