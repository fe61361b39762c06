// SPDX-License-Identifier: GPL-2.0-or-later
#include "fuzz/damaged_patch.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "support/complaints.hpp"
#include "support/invariants.hpp"
#include "support/sides.hpp"

namespace qmorph::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kRecord = 4;

struct Record {
  std::uint8_t what = 0, which = 0, where = 0, amount = 0;

  static double share(std::uint8_t byte) { return (double(byte) - 128) / 128; }
};

enum class Shape { square, ring, spiral };

Shape shape_of(const Record& first) { return Shape(first.what % 3); }

/// Of the grid's node (u, v), both from 0 to 1.
Vector3d place(Shape shape, double u, double v, double amount) {
  if (shape == Shape::square) return {4 * u, 4 * v, 0};
  const double turns = shape == Shape::ring ? 1 : 0.5 + amount;
  const double angle = 2 * std::numbers::pi * turns * u;
  const double radius = 2 + v + (shape == Shape::ring ? 0 : 0.5 * turns * u);  // half as much a turn as it is wide
  return {radius * std::cos(angle), -radius * std::sin(angle), 0};
}

Patch grid(const Record& r) {
  const Shape shape = shape_of(r);
  const bool is_closed = shape == Shape::ring;
  const Index columns = (shape == Shape::square ? 1 : 4) + r.which % 4, rows = 1 + r.where % 4;
  const Index stride = columns + (is_closed ? 0 : 1);
  Patch patch;
  for (Index j = 0; j <= rows; ++j)
    for (Index i = 0; i < stride; ++i)
      patch.points.push_back(place(shape, double(i) / columns, double(j) / rows, double(r.amount) / 128));
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) {
      const Index a = j * stride + i, b = j * stride + (i + 1) % stride, c = b + stride, d = a + stride;
      const bool leans_left = r.amount & 1 && (i + j) % 2;
      patch.triangles.push_back(leans_left ? std::array{a, b, d} : std::array{a, b, c});
      patch.triangles.push_back(leans_left ? std::array{b, c, d} : std::array{a, c, d});
    }
  return patch;
}

double odd_number(std::uint8_t byte) {
  using Limits = std::numeric_limits<double>;
  constexpr std::array kNumbers{
      Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), 1e300, 1e-300, -0.0, 100.0};
  return kNumbers[byte % kNumbers.size()];
}

/// Turns two triangles with a common edge, which follow each other in the array, into a quad.
void pair_up(Patch& patch, Index first) {
  const auto t = patch.triangles[first], u = patch.triangles[(first + 1) % patch.triangles.size()];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      if (t[i] != u[(j + 1) % 3] || t[(i + 1) % 3] != u[j]) continue;
      patch.quads.push_back({t[i], u[(j + 2) % 3], t[(i + 1) % 3], t[(i + 2) % 3]});
      std::erase_if(patch.triangles, [&](const auto& other) { return other == t || other == u; });
      return;
    }
}

void damage(Patch& patch, const Record& r) {
  const Index points = Index(patch.points.size()), node = r.which % points, other = r.where % points;
  const Index beyond = r.amount == 255 ? kNone : points + r.amount;
  const Index t = r.which % Index(patch.triangles.size());
  std::array<Index, 3>& triangle = patch.triangles[t];
  Vector3d& p = patch.points[node];
  switch (r.what % 17) {
    case 0:
      p.head<2>() += 2 * Vector2d(Record::share(r.where), Record::share(r.amount));
      break;
    case 1:
      p.z() += Record::share(r.where) / 2;
      break;
    case 2:
      p = patch.points[other];
      break;
    case 3:
      p[r.where % 3] = odd_number(r.amount);
      break;
    case 4:
      std::swap(triangle[0], triangle[1]);
      break;
    case 5:
      if (patch.triangles.size() > 1) patch.triangles.erase(patch.triangles.begin() + t);
      break;
    case 6:
      patch.triangles.push_back(std::array(triangle));
      break;
    case 7:
      triangle[r.amount % 3] = other;
      break;
    case 8:
      triangle[r.where % 3] = beyond;
      break;
    case 9:
      patch.constraints.push_back({triangle[r.where % 3], triangle[(r.where + 1) % 3]});
      break;
    case 10:
      patch.constraints.push_back({node, other});
      break;
    case 11:
      patch.constraints.push_back({node, beyond});
      break;
    case 12:
      patch.fixed.push_back(r.where % 8 ? node : beyond);
      break;
    case 13:
      if (patch.triangles.size() > 2) pair_up(patch, t);
      break;
    case 14:  // flatter, as boundary layers are
      for (Vector3d& q : patch.points) q.y() *= std::ldexp(1, -int(r.which % 24));
      break;
    case 15:  // larger or smaller
      for (Vector3d& q : patch.points) q *= std::pow(10, r.which % 32 - 16);
      break;
    default:
      patch.points.push_back(p + Vector3d(Record::share(r.where), Record::share(r.amount), 0));
      patch.triangles.push_back({triangle[1], triangle[0], points});
  }
}

/// What is nearly flat is neither promised to stay in its plane to the last bit, nor measured on a surface.
bool is_nearly_flat(const Patch& patch) {
  double height = 0, width = 0;
  for (const Vector3d& p : patch.points) {
    height = std::max(height, std::abs(p.z()));
    width = std::max(width, p.head<2>().cwiseAbs().maxCoeff());
  }
  return height < 1e-3 * width;
}

/// Whether triangles face away from most others.
bool is_crumpled(const Patch& patch) {
  const Vector3d normal = area_vector(patch.points, patch.triangles, {});
  return std::any_of(patch.triangles.begin(), patch.triangles.end(),
                     [&](const auto& t) { return !(area_vector(patch.points, {t}, {}).dot(normal) > 0); });
}

/// The corners in the plane of the mesh.
using Outline = std::vector<Vector2d>;

/// How far two convex outlines lie within each other, across the side where that is least.
double depth(const Outline& a, const Outline& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Outline* sides : {&a, &b})
    for (std::size_t i = 0; i < sides->size(); ++i) {
      const Vector2d along = (*sides)[(i + 1) % sides->size()] - (*sides)[i];
      const Vector2d outwards = Vector2d(along.y(), -along.x()).normalized();
      double deepest = 0;
      for (const Vector2d& p : sides == &a ? b : a) deepest = std::max(deepest, outwards.dot((*sides)[i] - p));
      least = std::min(least, deepest);
    }
  return least;
}

}  // namespace

Patch damaged_patch(std::span<const std::uint8_t> bytes) {
  const auto record = [&](std::size_t at) {
    return at + kRecord <= bytes.size() ? Record{bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]} : Record();
  };
  Patch patch = grid(record(0));
  for (std::size_t at = kRecord; at + kRecord <= bytes.size() && !patch.triangles.empty(); at += kRecord)
    damage(patch, record(at));
  // In space overlaps are allowed, and take long for their size; in a plane they are refused.
  if (!why_unsound(patch) && (shape_of(record(0)) != Shape::square || is_crumpled(patch) || is_nearly_flat(patch)))
    for (Vector3d& p : patch.points) p.z() = 0;
  return patch;
}

std::optional<std::string> why_unsound(const Patch& patch) {
  std::optional<std::string> why;
  const auto look_at = [&](const auto& elements) {
    for (const auto& nodes : elements)
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i] >= patch.points.size()) why = "an index out of range";
        if (nodes[i] == nodes[(i + 1) % nodes.size()]) why = "an element with a node twice";
      }
  };
  look_at(patch.triangles);
  look_at(patch.quads);
  look_at(patch.constraints);
  for (const Index node : patch.fixed)
    if (node >= patch.points.size()) why = "a fixed node out of range";
  for (const Vector3d& p : patch.points)
    if (!p.allFinite()) why = "a coordinate that is not finite";
  return why;
}

bool is_promised_nothing(const Patch& patch) {
  constexpr double kSizes = 1e12;
  bool is_bad = false;
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for_each_edge(sides_of(patch.triangles, patch.quads), [&](auto first, auto last) {
    is_bad = is_bad || last - first > 2 || (last - first == 2 && first[0].forward == first[1].forward);
    const double length = (patch.points[first->high] - patch.points[first->low]).norm();
    if (length > 0) shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  });
  is_bad = is_bad || longest > kSizes * shortest;
  const Vector3d normal = area_vector(patch.points, patch.triangles, {});
  double area = 0;
  for (const auto& t : patch.triangles) area += area_vector(patch.points, {t}, {}).norm();
  is_bad = is_bad || !(normal.norm() > 1e-9 * area);
  for (const auto& quad : patch.quads)
    for (std::size_t i = 0; i < 4; ++i) {
      const Vector3d& p = patch.points[quad[i]];
      const Vector3d ahead = patch.points[quad[(i + 1) % 4]] - p, behind = patch.points[quad[(i + 3) % 4]] - p;
      is_bad = is_bad || !(ahead.cross(behind).dot(normal) > 0);
    }
  return is_bad;
}

Patch without_loose_wishes(Patch patch) {
  std::set<std::pair<Index, Index>> edges;
  for (const Side& side : sides_of(patch.triangles, patch.quads)) edges.insert({side.low, side.high});
  std::erase_if(patch.constraints, [&](const auto& c) { return !edges.contains(std::minmax(c[0], c[1])); });
  std::set<Index> used;
  for (const auto& [low, high] : edges) used.insert({low, high});
  std::erase_if(patch.fixed, [&](Index node) { return !used.contains(node); });
  return patch;
}

std::optional<std::string> find_overlap(const QuadMesh& mesh, std::size_t kept) {
  constexpr double kDeep = 1e-6;  // of an element's diameter
  const Vector3d normal = area_vector(mesh.points, mesh.triangles, mesh.quads).normalized();
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<Outline> outlines;
  const auto add = [&](const auto& nodes) {
    Outline& outline = outlines.emplace_back();
    for (const Index i : nodes) outline.emplace_back(u.dot(mesh.points[i]), v.dot(mesh.points[i]));
  };
  for (const auto& t : mesh.triangles) add(t);
  for (std::size_t q = kept; q < mesh.quads.size(); ++q) add(mesh.quads[q]);
  for (std::size_t a = 0; a < outlines.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const double size = (outlines[a][0] - outlines[a][2]).norm() + (outlines[b][0] - outlines[b][2]).norm();
      if (depth(outlines[a], outlines[b]) > kDeep * size)
        return "elements overlap at " + at(outlines[a][0].x() * u + outlines[a][0].y() * v);
    }
  return std::nullopt;
}

}  // namespace qmorph::test
