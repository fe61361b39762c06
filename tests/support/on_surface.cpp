// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/on_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "support/sides.hpp"

namespace qmorph::test {
namespace {

using Eigen::Vector3d;

/// Of the diagonal.
constexpr double kOnSurface = 1e-9;

/// The input's elements as triangles.
class Surface {
 public:
  explicit Surface(const Patch& patch) : points_(patch.points), triangles_(patch.triangles) {
    for (const auto& q : patch.quads) {
      triangles_.push_back({q[0], q[1], q[2]});
      triangles_.push_back({q[0], q[2], q[3]});
    }
    std::vector<Vector3d> normals;
    for (const auto& t : triangles_)
      normals.push_back((points_[t[1]] - points_[t[0]]).cross(points_[t[2]] - points_[t[0]]).normalized());
    near_.resize(normals.size());
    is_folded_.assign(normals.size(), 0);
    for (std::size_t t = 0; t < normals.size(); ++t) near_[t] = 3 * normals[t];
    for_each_edge(sides_of(triangles_, {}), [&](auto first, auto last) {
      if (last - first != 2) return;
      const Index a = first[0].element, b = first[1].element;
      near_[a] += normals[b];
      near_[b] += normals[a];
      if (normals[a].dot(normals[b]) < 0) is_folded_[a] = is_folded_[b] = 1;
    });
    for (Vector3d& n : near_) n.normalize();
    sort_by_centre();
  }

  struct Foot {
    double distance = std::numeric_limits<double>::infinity();
    std::size_t triangle = 0;
  };
  /// Of several as close, the first. Looks along x, both ways from the point, as far as a triangle may be closer.
  Foot closest(const Vector3d& p) const {
    Foot foot;
    const auto look_at = [&](std::size_t t) {
      const double distance = distance_to(t, p);
      if (distance < foot.distance || (distance == foot.distance && t < foot.triangle)) foot = {distance, t};
    };
    const auto start = std::lower_bound(centres_.begin(), centres_.end(), Centre{p.x(), 0});
    for (auto i = start; i != centres_.end() && i->first - p.x() - reach_ <= foot.distance; ++i) look_at(i->second);
    for (auto i = start; i != centres_.begin() && p.x() - std::prev(i)->first - reach_ <= foot.distance; --i)
      look_at(std::prev(i)->second);
    return foot;
  }
  const Vector3d& normal_near(std::size_t t) const { return near_[t]; }
  bool is_folded(std::size_t t) const { return is_folded_[t]; }

 private:
  using Centre = std::pair<double, std::size_t>;  ///< x of the centre of a triangle

  void sort_by_centre() {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      double centre = 0;
      for (const Index v : triangles_[t]) centre += points_[v].x() / 3;
      for (const Index v : triangles_[t]) reach_ = std::max(reach_, std::abs(points_[v].x() - centre));
      centres_.emplace_back(centre, t);
    }
    std::sort(centres_.begin(), centres_.end());
  }

  static double distance_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
    const double length2 = (b - a).squaredNorm();
    const double t = length2 > 0 ? std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) : 0.0;
    return (a + t * (b - a) - p).norm();
  }
  double distance_to(std::size_t t, const Vector3d& p) const {
    const Vector3d &a = points_[triangles_[t][0]], &b = points_[triangles_[t][1]], &c = points_[triangles_[t][2]];
    const Vector3d n = (b - a).cross(c - a);
    if (n.dot((b - a).cross(p - a)) >= 0 && n.dot((c - b).cross(p - b)) >= 0 && n.dot((a - c).cross(p - c)) >= 0 &&
        n.squaredNorm() > 0)
      return std::abs(n.dot(p - a)) / n.norm();
    return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
  }

  const std::vector<Vector3d>& points_;
  std::vector<std::array<Index, 3>> triangles_;
  std::vector<Vector3d> near_;  ///< normal of each triangle weighed 3, those of its neighbours 1
  std::vector<char> is_folded_;
  std::vector<Centre> centres_;
  double reach_ = 0;  ///< of a triangle from its centre, along x
};

template <class Elements>
void check_corners(const Surface& surface, const QuadMesh& out, const Elements& elements, std::size_t kept,
                   Complaints& bad) {
  for (std::size_t e = kept; e < elements.size(); ++e) {
    const auto& nodes = elements[e];
    const std::size_t n = nodes.size();
    Vector3d centre = Vector3d::Zero();
    for (Index v : nodes) centre += out.points[v] / double(n);
    std::vector<Vector3d> normals;
    const auto foot = surface.closest(centre);
    Vector3d whole = surface.normal_near(foot.triangle);
    bool folded = surface.is_folded(foot.triangle);
    for (Index v : nodes) {
      const auto near = surface.closest(out.points[v] + 0.25 * (centre - out.points[v]));
      normals.push_back(surface.normal_near(near.triangle));
      whole += normals.back();
      folded = folded || surface.is_folded(near.triangle);
    }
    if (folded) continue;
    for (std::size_t i = 0; i < n; ++i) {
      const Vector3d& p = out.points[nodes[i]];
      const Vector3d corner = (out.points[nodes[(i + 1) % n]] - p).cross(out.points[nodes[(i + n - 1) % n]] - p);
      if (!(corner.dot(normals[i]) > 0 || corner.dot(whole) > 0))
        bad.add("surface", "element ", e, " of ", n, " nodes is turned over at ", at(p));
    }
  }
}

double diagonal(const std::vector<Vector3d>& points) {
  Vector3d low = points[0], high = low;
  for (const Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (high - low).norm();
}

}  // namespace

int euler_characteristic(const std::vector<std::array<Index, 3>>& triangles,
                         const std::vector<std::array<Index, 4>>& quads) {
  std::set<Index> nodes;
  for (const auto& t : triangles) nodes.insert(t.begin(), t.end());
  for (const auto& q : quads) nodes.insert(q.begin(), q.end());
  int edges = 0;
  for_each_edge(sides_of(triangles, quads), [&](auto, auto) { ++edges; });
  return int(nodes.size()) - edges + int(triangles.size()) + int(quads.size());
}

void check_on_surface(const Patch& in, const QuadMesh& out, Complaints& bad) {
  const Surface surface(in);
  const double size = diagonal(in.points);
  for (const Vector3d& p : out.points)
    if (const double distance = surface.closest(p).distance; !(distance <= kOnSurface * size))
      bad.add("surface", "a node is ", distance, " off, at ", at(p));
  check_corners(surface, out, out.triangles, 0, bad);
  check_corners(surface, out, out.quads, in.quads.size(), bad);
  const int before = euler_characteristic(in.triangles, in.quads);
  const int after = euler_characteristic(out.triangles, out.quads);
  if (before != after) bad.add("surface", "Euler's characteristic ", before, " became ", after);
}

}  // namespace qmorph::test
