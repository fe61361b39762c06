// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "support/halves.hpp"

namespace qmorph::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;
/// Radians that a surface may turn by along one edge: more is a crease, or a shape that is not what it was made for.
constexpr double kMostTurn = 0.3;

/// A flat patch in coordinates of its own plane, from 0 on.
std::vector<Vector2d> in_plane(const Patch& patch) {
  Vector3d normal = Vector3d::Zero();
  for (const auto& t : patch.triangles)
    normal += (patch.points[t[1]] - patch.points[t[0]]).cross(patch.points[t[2]] - patch.points[t[0]]);
  normal.normalize();
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<Vector2d> flat;
  for (const Vector3d& p : patch.points) flat.emplace_back(p.dot(u), p.dot(v));
  Vector2d low = flat[0];
  for (const Vector2d& p : flat) low = low.cwiseMin(p);
  for (Vector2d& p : flat) p -= low;
  return flat;
}

double longest_edge(const Patch& patch) {
  double longest = 0;
  for (const auto& t : patch.triangles)
    for (int i = 0; i < 3; ++i) longest = std::max(longest, (patch.points[t[i]] - patch.points[t[(i + 1) % 3]]).norm());
  for (const auto& q : patch.quads)
    for (int i = 0; i < 4; ++i) longest = std::max(longest, (patch.points[q[i]] - patch.points[q[(i + 1) % 4]]).norm());
  return longest;
}

/// A domain whose points are mapped from its plane to space; sizes are those of the plane.
Patch bent(const Patch& flat, const std::function<Vector3d(const Vector2d&)>& map) {
  Patch patch = flat;
  const std::vector<Vector2d> points = in_plane(flat);
  for (std::size_t i = 0; i < points.size(); ++i) patch.points[i] = map(points[i]);
  return patch;
}

double extent_of(const std::vector<Vector2d>& points) {
  Vector2d high = points[0];
  for (const Vector2d& p : points) high = high.cwiseMax(p);
  return high.norm();
}

/// Waves in both directions that turn by no more than they may along the longest edge.
Patch wavy(const Patch& flat, Rng& rng, bool saddle) {
  const double edge = longest_edge(flat), extent = extent_of(in_plane(flat));
  const double length = std::max(extent / rng.between(1, 6), 8 * edge), wave = 2 * kPi / length;
  const double height = std::min(0.8 / wave, kMostTurn / (2 * edge * wave * wave)) * rng.between(0.3, 1);
  const double a = rng.between(0, 6), b = rng.between(0, 6);
  if (saddle)
    return bent(flat, [&](const Vector2d& p) {
      const Vector2d q = (p - Vector2d(extent / 2, extent / 3)) / std::max(extent, 4 * edge);
      return Vector3d(p.x(), p.y(), 0.5 * std::max(extent, 4 * edge) * (q.x() * q.x() - q.y() * q.y()));
    });
  return bent(flat, [&](const Vector2d& p) {
    return Vector3d(p.x(), p.y(), height * std::sin(wave * p.x() + a) * std::cos(wave * p.y() + b));
  });
}

/// On a sphere, around a pole: distances from it and directions are the plane's.
Patch cap(const Patch& flat, Rng& rng) {
  const std::vector<Vector2d> points = in_plane(flat);
  const Vector2d middle = Vector2d::Constant(0.4 * extent_of(points));
  double reach = 0;
  for (const Vector2d& p : points) reach = std::max(reach, (p - middle).norm());
  const double radius = std::max(reach / rng.between(0.5, 1.8), longest_edge(flat) / kMostTurn);
  return bent(flat, [&](const Vector2d& p) {
    const double r = (p - middle).norm() / radius;
    const Vector2d along = r > 0 ? Vector2d((p - middle) / (r * radius)) : Vector2d::UnitX();
    return Vector3d(radius * std::sin(r) * along.x(), radius * std::sin(r) * along.y(), radius * std::cos(r));
  });
}

/// Rows of nodes, closed in one or both directions, with diagonals either way.
Patch grid(int rows, int columns, bool rows_close, bool columns_close, Rng& rng,
           const std::function<Vector3d(double, double)>& at, double jitter) {
  Patch patch;
  const int points_down = rows + !rows_close, points_across = columns + !columns_close;
  for (int i = 0; i < points_down; ++i)
    for (int j = 0; j < points_across; ++j) {
      const bool inner_row = rows_close || (i > 0 && i < rows), inner_column = columns_close || (j > 0 && j < columns);
      const double di = inner_row && inner_column ? jitter * rng.between(-1, 1) : 0;
      const double dj = inner_row && inner_column ? jitter * rng.between(-1, 1) : 0;
      patch.points.push_back(at((i + di) / rows, (j + dj + (i % 2 && inner_column ? 0.4 : 0)) / columns));
    }
  const auto node = [&](int i, int j) { return Index((i % points_down) * points_across + j % points_across); };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const Index a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      const bool first = (patch.points[a] - patch.points[c]).norm() < (patch.points[b] - patch.points[d]).norm();
      add_halves(patch, {a, b, c, d}, first);
    }
  return patch;
}

void add_noise(Patch& patch, double amount, Rng& rng) {
  const double edge = [&] {
    double sum = 0;
    for (const auto& t : patch.triangles) sum += (patch.points[t[0]] - patch.points[t[1]]).norm();
    return sum / double(patch.triangles.size());
  }();
  for (Vector3d& p : patch.points)
    p += amount * edge * Vector3d(rng.between(-1, 1), rng.between(-1, 1), rng.between(-1, 1));
}

/// Only triangles, and no lines: for surfaces that have nothing else.
Patch random_closed(Rng& rng, std::string& kind) {
  switch (rng.range(0, 4)) {
    case 0:
      kind = "sphere";
      return sphere(rng.between(0.15, 0.5), rng);
    case 1:
      kind = "torus";
      return torus(1, rng.between(0.15, 0.6), rng.between(0.1, 0.2), rng);
    case 2:
      kind = "double torus";
      return double_torus(rng.between(0.12, 0.2), rng);
    case 3: {
      kind = "box";
      return box({rng.between(0.5, 2), rng.between(0.5, 2), rng.between(0.5, 2)}, rng.between(0.15, 0.4), rng);
    }
    default: {
      kind = "tube";
      return tube(rng.between(2, 8), rng.between(0.3, 0.6), rng.between(0.1, 0.25), rng.between(0, 1.5), rng);
    }
  }
}

}  // namespace

int count_for(double length, double size, int least) { return std::max(least, int(std::lround(length / size))); }

void drop_unused(Patch& patch) {
  std::vector<Index> row(patch.points.size(), kNone);
  std::vector<Vector3d> points;
  for (auto& t : patch.triangles)
    for (Index& v : t) {
      if (row[v] == kNone) row[v] = Index(points.size()), points.push_back(patch.points[v]);
      v = row[v];
    }
  patch.points = std::move(points);
}

Patch rolled(const Patch& flat, double tip, Rng& rng) {
  const std::vector<Vector2d> points = in_plane(flat);
  const double extent = extent_of(points), edge = longest_edge(flat);
  if (tip == 0) {
    const double radius = std::max(extent / rng.between(0.5, 5), edge / kMostTurn), turn = rng.between(0, kPi);
    return bent(flat, [&](const Vector2d& p) {
      const double x = std::cos(turn) * p.x() - std::sin(turn) * p.y(),
                   y = std::sin(turn) * p.x() + std::cos(turn) * p.y();
      return Vector3d(radius * std::cos(x / radius), radius * std::sin(x / radius), y);
    });
  }
  // Unrolled, a cone is a fan: the domain lies some way from its tip.
  const double away = std::max({0.3 * extent, edge / (kMostTurn * tip), extent / (6 * tip)});
  return bent(flat, [&](const Vector2d& p) {
    const Vector2d q(p.x() + away, p.y() - 0.4 * extent);
    const double r = q.norm(), angle = std::atan2(q.y(), q.x()) / tip;
    return Vector3d(r * tip * std::cos(angle), r * tip * std::sin(angle), -r * std::sqrt(1 - tip * tip));
  });
}

/// From the faces of an icosahedron.
Patch sphere(double size, Rng& rng) {
  const double golden = 0.5 * (1 + std::sqrt(5.0));
  std::vector<Vector3d> corners;
  for (int k = 0; k < 3; ++k)
    for (int a : {-1, 1})
      for (int b : {-1, 1}) {
        Vector3d p = Vector3d::Zero();
        p[k] = a, p[(k + 1) % 3] = b * golden;
        corners.push_back(p);
      }
  const int pieces = count_for(1.1, size, 1);
  Patch patch;
  std::map<std::array<long, 3>, Index> node_at;
  const auto node = [&](const Vector3d& place) {
    const Vector3d p = place.normalized();
    const std::array<long, 3> key{std::lround(p.x() * 1e6), std::lround(p.y() * 1e6), std::lround(p.z() * 1e6)};
    const auto [at, is_new] = node_at.emplace(key, Index(patch.points.size()));
    if (is_new) patch.points.push_back(p);
    return at->second;
  };
  for (int i = 0; i < 12; ++i)
    for (int j = i + 1; j < 12; ++j)
      for (int k = j + 1; k < 12; ++k) {
        Vector3d a = corners[i], b = corners[j], c = corners[k];
        if ((a - b).norm() > 2.1 || (b - c).norm() > 2.1 || (c - a).norm() > 2.1) continue;
        if ((b - a).cross(c - a).dot(a) < 0) std::swap(b, c);
        const auto at = [&](int s, int t) { return node(a + (b - a) * s / pieces + (c - a) * t / pieces); };
        for (int s = 0; s < pieces; ++s)
          for (int t = 0; s + t < pieces; ++t) {
            patch.triangles.push_back({at(s, t), at(s + 1, t), at(s, t + 1)});
            if (s + t + 1 < pieces) patch.triangles.push_back({at(s + 1, t), at(s + 1, t + 1), at(s, t + 1)});
          }
      }
  const double jitter = 0.2 / pieces;
  for (Vector3d& p : patch.points)
    p = (p + jitter * Vector3d(rng.between(-1, 1), rng.between(-1, 1), rng.between(-1, 1))).normalized();
  return patch;
}

Patch torus(double large, double small, double size, Rng& rng) {
  const int around = count_for(2 * kPi * large, size, 8), across = 2 * count_for(kPi * small, size, 3);
  return grid(
      2 * (around / 2), across, true, true, rng,
      [&](double s, double t) {
        const double u = 2 * kPi * s, v = 2 * kPi * t;
        const double r = large + small * std::cos(v);
        return Vector3d(r * std::cos(u), r * std::sin(u), small * std::sin(v));
      },
      0.2);
}

Patch box(const Vector3d& sides, double size, Rng& rng) {
  Patch patch;
  std::map<std::array<long, 3>, Index> node_at;
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const int rows = count_for(sides[u], size, 1), columns = count_for(sides[v], size, 1);
      Patch face = grid(
          rows, columns, false, false, rng,
          [&](double s, double t) {
            Vector3d p;
            p[axis] = end * sides[axis], p[u] = s * sides[u], p[v] = t * sides[v];
            return p;
          },
          0.15);
      std::vector<Index> row;
      for (const Vector3d& p : face.points) {
        const std::array<long, 3> key{std::lround(p.x() * 1e7), std::lround(p.y() * 1e7), std::lround(p.z() * 1e7)};
        const auto [at, is_new] = node_at.emplace(key, Index(patch.points.size()));
        if (is_new) patch.points.push_back(p);
        row.push_back(at->second);
      }
      for (auto t : face.triangles) {
        if (end == 0) std::swap(t[1], t[2]);
        patch.triangles.push_back({row[t[0]], row[t[1]], row[t[2]]});
      }
    }
  return patch;
}

Patch tube(double length, double radius, double size, double bend, Rng& rng) {
  const int rows = count_for(length, size, 2), columns = 2 * count_for(kPi * radius, size, 3);
  // A frame that is carried along, and turns a little each step; it never bends more sharply than the tube is thick.
  std::vector<Vector3d> middle{Vector3d::Zero()};
  std::vector<Eigen::Matrix3d> frame{Eigen::Matrix3d::Identity()};
  double about_x = 0, about_y = 0;
  for (int i = 0; i < rows; ++i) {
    if (i % 8 == 0) about_x = bend * rng.between(-0.4, 0.4), about_y = bend * rng.between(-0.4, 0.4);
    const double step = length / rows;
    const Eigen::Matrix3d turn = (Eigen::AngleAxisd(about_x * step / radius, Vector3d::UnitX()) *
                                  Eigen::AngleAxisd(about_y * step / radius, Vector3d::UnitY()))
                                     .toRotationMatrix();
    frame.push_back(frame.back() * turn);
    middle.push_back(middle.back() + step * frame.back().col(2));
  }
  return grid(
      rows, columns, false, true, rng,
      [&](double s, double t) {
        const double at = std::clamp(s * rows, 0.0, double(rows));
        const int i = std::min(rows - 1, int(at));
        const double share = at - i, angle = 2 * kPi * t;
        const Vector3d p = (1 - share) * middle[i] + share * middle[i + 1];
        const Eigen::Matrix3d& f = share < 0.5 ? frame[i] : frame[i + 1];
        return Vector3d(p + radius * (std::cos(angle) * f.col(0) + std::sin(angle) * f.col(1)));
      },
      0.15);
}

Patch pierced(const Patch& patch, const Vector3d& centre, double radius) {
  Patch rest = patch;
  std::erase_if(rest.triangles, [&](const auto& t) {
    return ((patch.points[t[0]] + patch.points[t[1]] + patch.points[t[2]]) / 3 - centre).norm() < radius;
  });
  drop_unused(rest);
  return rest;
}

Domain random_surface(std::uint64_t seed) {
  Rng rng(~seed * 3);
  Domain domain;
  switch (rng.range(0, 9)) {
    case 0:
    case 1: {
      domain = random_domain(rng.next() >> 20);
      domain.patch = rolled(domain.patch, 0, rng);
      domain.kind += ", on a cylinder";
      break;
    }
    case 2: {
      domain = random_domain(rng.next() >> 20);
      domain.patch = rolled(domain.patch, rng.between(0.3, 0.9), rng);
      domain.kind += ", on a cone";
      break;
    }
    case 3:
    case 4: {
      domain = random_domain(rng.next() >> 20);
      const bool saddle = rng.chance(0.3);
      domain.patch = wavy(domain.patch, rng, saddle);
      domain.kind += saddle ? ", on a saddle" : ", on waves";
      break;
    }
    case 5: {
      domain = random_domain(rng.next() >> 20);
      domain.patch = cap(domain.patch, rng);
      domain.kind += ", on a sphere";
      break;
    }
    default: {
      domain.patch = random_closed(rng, domain.kind);
      if (rng.chance(0.4)) {
        const int holes = rng.range(1, 4);
        for (int k = 0; k < holes && domain.patch.triangles.size() > 100; ++k) {
          const Patch whole = domain.patch;
          domain.patch = pierced(whole, rng.pick(whole.points), rng.between(0.2, 0.7));
          if (domain.patch.triangles.size() < 20) domain.patch = whole;
        }
        domain.kind += ", pierced";
      }
      if (rng.chance(0.25)) {
        add_noise(domain.patch, rng.between(0, 0.12), rng);
        domain.kind += ", noisy";
      }
    }
  }
  domain.patch = moved(domain.patch, rng.power_of_two(-10, 10), random_rotation(rng), Vector3d::Zero());
  if (rng.chance(0.3)) domain.patch = turned_over(domain.patch);
  if (rng.chance(0.3)) domain.patch = renumbered(domain.patch, rng);
  return domain;
}

}  // namespace qmorph::test
