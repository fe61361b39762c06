// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/invariants.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>

#include "support/complaints.hpp"
#include "support/on_surface.hpp"
#include "support/sides.hpp"

namespace qmorph::test {
namespace {

using Eigen::Vector3d;
using EdgeSet = std::set<std::pair<Index, Index>>;

/// A corner counts as convex from this sine on; a straight corner is about 1e-17.
constexpr double kStraight = 1e-12;
constexpr double kSameArea = 1e-9;
constexpr double kSamePlace = 1e-9;  // of the input's shortest edge
constexpr double kFlat = 1e-6;       // of the diagonal

double diagonal(const std::vector<Vector3d>& points) {
  Vector3d low = points[0], high = low;
  for (const Vector3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

EdgeSet constraint_set(const Patch& patch) {
  EdgeSet set;
  for (const auto& [a, b] : patch.constraints) set.insert(std::minmax(a, b));
  return set;
}

/// Everything that the single checks share.
struct Case {
  const Patch& in;
  const QuadMesh& out;
  std::vector<Side> in_sides, out_sides;
  std::vector<Index> row;  ///< of each input point in the output, kNone if it is gone
  Vector3d normal;
  Complaints bad;

  const Vector3d& place(Index out_row) const { return out.points[out_row]; }
  std::string edge(Index a, Index b) const { return at(place(a)) + " - " + at(place(b)); }
};

bool is_well_formed(Case& c) {
  const std::vector<Vector3d>& points = c.out.points;
  if (c.out.source.size() != points.size())
    c.bad.add("malformed", c.out.source.size(), " sources, ", points.size(), " points");
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite()) c.bad.add("malformed", "point ", i, " is not finite");
  const auto check = [&](const auto& elements) {
    for (const auto& nodes : elements)
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i] >= points.size()) c.bad.add("malformed", "node ", nodes[i], " of ", points.size());
        for (std::size_t j = 0; j < i; ++j)
          if (nodes[i] == nodes[j]) c.bad.add("malformed", "an element has node ", nodes[i], " twice");
      }
  };
  check(c.out.triangles);
  check(c.out.quads);
  return c.bad.empty();
}

/// Fills `row`.
bool has_good_sources(Case& c) {
  c.row.assign(c.in.points.size(), kNone);
  Index previous = kNone;
  for (Index i = 0; i < c.out.source.size(); ++i) {
    const Index source = c.out.source[i];
    if (source == kNone) {
      previous = kNone - 1;
      continue;
    }
    if (source >= c.in.points.size())
      c.bad.add("source", "point ", i, " says ", source, " of ", c.in.points.size());
    else if (previous != kNone && source <= previous)
      c.bad.add("source", "point ", i, " is out of order, ", at(c.place(i)));
    else
      c.row[source] = i;
    previous = source;
  }
  return c.bad.empty();
}

void check_fixed_nodes(Case& c) {
  std::vector<const char*> reason(c.in.points.size(), nullptr);
  for_each_edge(c.in_sides, [&](auto first, auto last) {
    if (last - first == 1) reason[first->low] = reason[first->high] = "on the boundary";
  });
  for (const auto& nodes : c.in.constraints)
    for (const Index i : nodes) reason[i] = "on a constraint";
  for (const auto& nodes : c.in.quads)
    for (const Index i : nodes) reason[i] = "of a kept quad";
  for (const Index i : c.in.fixed) reason[i] = "fixed";
  for (std::size_t i = 0; i < reason.size(); ++i) {
    if (!reason[i]) continue;
    const Vector3d& was = c.in.points[i];
    if (c.row[i] == kNone)
      c.bad.add("fixed node", reason[i], ", is gone: ", at(was));
    else if (std::memcmp(was.data(), c.place(c.row[i]).data(), sizeof(double) * 3) != 0)
      c.bad.add("fixed node", reason[i], ", has moved: ", at(was), " to ", at(c.place(c.row[i])));
  }
}

void check_boundary(Case& c) {
  std::set<std::pair<Index, Index>> before, after;  // directed, rows of the output
  const auto direct = [](const Side& s) { return s.forward ? std::pair(s.low, s.high) : std::pair(s.high, s.low); };
  for_each_edge(c.in_sides, [&](auto first, auto last) {
    const auto [from, to] = direct(*first);
    if (last - first == 1 && c.row[from] != kNone && c.row[to] != kNone) before.insert({c.row[from], c.row[to]});
  });
  for_each_edge(c.out_sides, [&](auto first, auto last) {
    if (last - first == 1) after.insert(direct(*first));
  });
  for (const auto& [a, b] : before)
    if (!after.contains({a, b}))
      c.bad.add("boundary", after.contains({b, a}) ? "turned round: " : "lost: ", c.edge(a, b));
  for (const auto& [a, b] : after)
    if (!before.contains({a, b}) && !before.contains({b, a})) c.bad.add("boundary", "new: ", c.edge(a, b));
}

void check_constraints(Case& c) {
  EdgeSet edges;
  for (const Side& s : c.out_sides) edges.insert({s.low, s.high});
  for (const auto& [a, b] : c.in.constraints) {
    if (c.row[a] == kNone || c.row[b] == kNone) continue;  // said already
    if (!edges.contains(std::minmax(c.row[a], c.row[b]))) c.bad.add("constraint", "lost: ", c.edge(c.row[a], c.row[b]));
  }
}

void check_kept_quads(Case& c) {
  for (std::size_t i = 0; i < c.in.quads.size(); ++i) {
    std::array<Index, 4> wanted = c.in.quads[i];
    for (Index& node : wanted) node = c.row[node];
    if (i >= c.out.quads.size() || c.out.quads[i] != wanted)
      c.bad.add("kept quad", "number ", i, " is another now, at ", at(c.in.points[c.in.quads[i][0]]));
  }
}

/// Of the edges that have a length. Points that no element uses, which may be far away, do not count.
double shortest_edge(const Case& c) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Side& s : c.in_sides) {
    const double length = (c.in.points[s.high] - c.in.points[s.low]).norm();
    if (length > 0) shortest = std::min(shortest, length);
  }
  return shortest;
}

/// Counts points at the place of another, to within kSamePlace.
std::size_t doubles(const std::vector<Vector3d>& points, double size) {
  std::map<std::array<double, 3>, std::size_t> places;
  std::size_t count = 0;
  for (const Vector3d& p : points) {
    std::array<double, 3> key;
    for (int k = 0; k < 3; ++k) key[std::size_t(k)] = std::round(p[k] / (size * kSamePlace));
    count += places[key]++ > 0;
  }
  return count;
}

void check_conformity(Case& c) {
  for_each_edge(c.out_sides, [&](auto first, auto last) {
    if (last - first > 2)
      c.bad.add("conformity", last - first, " elements at the edge ", c.edge(first->low, first->high));
    if (last - first == 2 && first[0].forward == first[1].forward)
      c.bad.add("conformity", "two elements on one side of ", c.edge(first->low, first->high));
  });
  std::vector<char> used(c.out.points.size(), 0);
  std::set<std::vector<Index>> seen;
  const auto check = [&](const auto& elements) {
    for (const auto& nodes : elements) {
      std::vector<Index> sorted(nodes.begin(), nodes.end());
      std::sort(sorted.begin(), sorted.end());
      for (const Index i : sorted) used[i] = 1;
      if (!seen.insert(sorted).second) c.bad.add("conformity", "an element twice at ", at(c.place(sorted[0])));
    }
  };
  check(c.out.triangles);
  check(c.out.quads);
  for (Index i = 0; i < used.size(); ++i)
    if (!used[i]) c.bad.add("conformity", "no element uses the node at ", at(c.place(i)));
  const double size = shortest_edge(c);
  const std::size_t before = doubles(c.in.points, size), after = doubles(c.out.points, size);
  if (after > before) c.bad.add("conformity", after - before, " nodes at the place of another");
}

void check_orientation(Case& c) {
  const auto check = [&](const auto& elements, std::size_t kept, const char* name) {
    for (std::size_t e = kept; e < elements.size(); ++e) {
      const auto& nodes = elements[e];
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Vector3d& p = c.place(nodes[i]);
        const Vector3d ahead = c.place(nodes[(i + 1) % nodes.size()]) - p;
        const Vector3d behind = c.place(nodes[(i + nodes.size() - 1) % nodes.size()]) - p;
        const double sine = ahead.cross(behind).dot(c.normal) / (ahead.norm() * behind.norm());
        if (!(sine > kStraight)) c.bad.add("orientation", name, " ", e, " has a corner of sine ", sine, " at ", at(p));
      }
    }
  };
  check(c.out.triangles, 0, "triangle");
  check(c.out.quads, c.in.quads.size(), "quad");
}

/// Joins elements through edges that are no constraints, and counts.
class Regions {
 public:
  /// Elements from `end` on (quads that are kept) belong to no region.
  Regions(const std::vector<Side>& sides, Index triangle_count, Index quad_begin, Index end, const EdgeSet& walls)
      : parent_(end), sides_(end, 0), triangles_(end, 0), skip_from_(triangle_count), skip_to_(quad_begin) {
    for (Index e = 0; e < end; ++e) parent_[e] = e;
    std::vector<Index> loose;
    for_each_edge(sides, [&](auto first, auto last) {
      std::vector<Index> here;
      for (auto s = first; s != last; ++s)
        if (counts(s->element)) here.push_back(s->element);
      if (here.size() == 2 && !walls.contains({first->low, first->high}))
        parent_[root(here[0])] = root(here[1]);
      else
        loose.insert(loose.end(), here.begin(), here.end());
    });
    for (const Index e : loose) ++sides_[root(e)];
    for (Index e = 0; e < triangle_count; ++e) ++triangles_[root(e)];
  }

  template <class Visit>
  void for_each(Visit&& visit) {
    for (Index e = 0; e < parent_.size(); ++e)
      if (counts(e) && root(e) == e) visit(e, sides_[e], triangles_[e]);
  }

 private:
  bool counts(Index e) const { return e < parent_.size() && !(e >= skip_from_ && e < skip_to_); }
  Index root(Index e) {
    while (parent_[e] != e) e = parent_[e] = parent_[parent_[e]];
    return e;
  }

  std::vector<Index> parent_;
  std::vector<std::size_t> sides_, triangles_;
  Index skip_from_, skip_to_;
};

void check_parity(Case& c) {
  EdgeSet walls;
  for (const auto& [a, b] : c.in.constraints)
    if (c.row[a] != kNone && c.row[b] != kNone) walls.insert(std::minmax(c.row[a], c.row[b]));
  const Index triangle_count = Index(c.out.triangles.size()), kept_end = triangle_count + Index(c.in.quads.size());
  const Index end = std::max(kept_end, triangle_count + Index(c.out.quads.size()));
  Regions after(c.out_sides, triangle_count, kept_end, end, walls);
  RegionCount found;
  const auto somewhere = [&](Index e) {
    return at(c.place(e < triangle_count ? c.out.triangles[e][0] : c.out.quads[e - triangle_count][0]));
  };
  after.for_each([&](Index e, std::size_t sides, std::size_t triangles) {
    ++found.regions;
    found.odd += sides % 2;
    if (triangles > sides % 2)
      c.bad.add("parity", triangles, " triangles in the region of ", sides, " sides at ", somewhere(e));
  });
  const RegionCount wanted = count_regions(c.in);
  if (found.regions != wanted.regions || found.odd != wanted.odd)
    c.bad.add("parity", "regions ", wanted.regions, " (odd ", wanted.odd, ") became ", found.regions, " (odd ",
              found.odd, ")");
}

void check_area(Case& c) {
  const Vector3d before = area_vector(c.in.points, c.in.triangles, c.in.quads);
  const Vector3d after = area_vector(c.out.points, c.out.triangles, c.out.quads);
  if (!(std::abs(after.dot(c.normal) - before.dot(c.normal)) <= kSameArea * before.norm()))
    c.bad.add("area", before.dot(c.normal) / 2, " became ", after.dot(c.normal) / 2);
  const double size = diagonal(c.in.points), height = c.normal.dot(c.in.points[0]);
  const auto off_plane = [&](const Vector3d& p) { return std::abs(c.normal.dot(p) - height); };
  double before_off = 0;
  for (const Vector3d& p : c.in.points) before_off = std::max(before_off, off_plane(p));
  for (const Vector3d& p : c.out.points)
    if (!(off_plane(p) <= before_off + kSameArea * (size + std::abs(height))))
      c.bad.add("area", "a node is off the plane: ", at(p));
}

bool is_flat(const Patch& patch) {
  const Vector3d area = area_vector(patch.points, patch.triangles, patch.quads), normal = area.normalized();
  const double size = diagonal(patch.points);
  return area.norm() > kFlat * size * size &&
         std::all_of(patch.points.begin(), patch.points.end(),
                     [&](const Vector3d& p) { return std::abs(normal.dot(p - patch.points[0])) <= kFlat * size; });
}

}  // namespace

Eigen::Vector3d area_vector(const std::vector<Vector3d>& points, const std::vector<std::array<Index, 3>>& triangles,
                            const std::vector<std::array<Index, 4>>& quads) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& t : triangles) sum += (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
  for (const auto& q : quads) sum += (points[q[2]] - points[q[0]]).cross(points[q[3]] - points[q[1]]);
  return sum;
}

RegionCount count_regions(const Patch& patch) {
  const Index count = Index(patch.triangles.size());
  Regions regions(sides_of(patch.triangles, patch.quads), count, count, count, constraint_set(patch));
  RegionCount result;
  regions.for_each([&](Index, std::size_t sides, std::size_t) {
    ++result.regions;
    result.odd += sides % 2;
  });
  return result;
}

std::vector<std::string> broken_invariants(const Patch& in, const QuadMesh& out) {
  Case c{in, out, {}, {}, {}, area_vector(in.points, in.triangles, in.quads).normalized(), {}};
  if (!is_well_formed(c) || !has_good_sources(c)) return c.bad.lines();
  c.in_sides = sides_of(in.triangles, in.quads);
  c.out_sides = sides_of(out.triangles, out.quads);
  check_fixed_nodes(c);
  check_boundary(c);
  check_constraints(c);
  check_kept_quads(c);
  check_conformity(c);
  check_parity(c);
  if (is_flat(in)) {
    check_orientation(c);
    check_area(c);
  } else {
    check_on_surface(in, out, c.bad);
  }
  return c.bad.lines();
}

}  // namespace qmorph::test
