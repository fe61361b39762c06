// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/faults.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/describe.hpp"
#include "geometry/predicates.hpp"
#include "kernel/is_any.hpp"
#include "space/mesh_normals.hpp"
#include "space/triangle_tree.hpp"

namespace qmorph::space {
namespace {

using Eigen::Vector3d;

template <std::size_t N>
constexpr double kLeastSine = N == 3 ? kDegenerateSine : kStraightSine;

template <std::size_t N>
Corners<N> corners_of(std::span<const Vector3d> points, const std::array<Index, N>& nodes) {
  Corners<N> corners;
  for (std::size_t i = 0; i < N; ++i) corners[i] = points[nodes[i]];
  return corners;
}

/// Nodes less edges plus elements.
long characteristic(std::size_t nodes, std::span<const std::array<Index, 3>> triangles,
                    std::span<const std::array<Index, 4>> quads) {
  const ElementSides sides(nodes, triangles, quads);
  std::vector<char> used(nodes, 0);
  long count = long(sides.elements());
  for (Index side = 0; side < sides.slots(); ++side) {
    const Index node = sides.node(side);
    if (node == kNone) continue;
    if (!used[node]) used[node] = 1, ++count;
    count -= sides.opposite(side) == kNone || side < sides.opposite(side);
  }
  return count;
}

Defect defect_at(const char* what, const Vector3d& p) { return {std::string(what) + " at " + describe(p), p}; }

/// Corner with the smallest sine, if that is too small; else N.
template <std::size_t N>
std::size_t bad_corner(const std::array<double, N>& sines) {
  const auto least = std::min_element(sines.begin(), sines.end());
  return *least > kLeastSine<N> ? N : std::size_t(least - sines.begin());
}

/// Joined triangles of which one lies back over the other, or has no normal. Where a thin tube has few triangles around
/// they turn by a right angle and more, and elements that are not turned over can be found all the same.
bool are_folded(const Background& surface, Index t, Index other) {
  const Vector3d &a = surface.normal(t), &b = surface.normal(other);
  return a.isZero() || b.isZero() || a.dot(b) < kFold;
}

/// Elements among those around them, which say whether one is good.
class Neighbourhood {
 public:
  /// Arrays must outlive it.
  Neighbourhood(std::span<const Vector3d> points, std::span<const std::array<Index, 3>> triangles,
                std::span<const std::array<Index, 4>> quads, std::span<const std::array<Index, 2>> barriers)
      : points_(points),
        triangles_(triangles),
        quads_(quads),
        sides_(points.size(), triangles, quads, barriers),
        normals_(points, sides_) {}

  Index elements() const { return sides_.elements(); }
  /// Corner of a quad that is bad, or 4.
  std::size_t bad_corner_of_quad(Index q) const {
    const Corners<4> p = corners_of<4>(points_, quads_[q]);
    const std::size_t bad = bad_corner(corner_sines(p, normals_.of<4>(Index(triangles_.size()) + q)));
    return bad == 4 && crosses_itself(p) ? 0 : bad;
  }
  /// It is turned over, or has a corner that is not convex.
  bool has_bad_corner(Index element) const {
    if (!sides_.is_triangle(element)) return bad_corner_of_quad(element - Index(triangles_.size())) < 4;
    return bad_corner(corner_sines(corners_of<3>(points_, triangles_[element]), normals_.of<3>(element))) < 3;
  }
  /// How many neighbours it lies back over.
  int folds(Index element) const {
    int count = 0;
    for (Index side = 4 * element; side < 4 * element + sides_.degree(element); ++side)
      if (const Index other = sides_.opposite(side); other != kNone)
        count += normals_.own(element).dot(normals_.own(other / 4)) < kFold;
    return count;
  }

 private:
  std::span<const Vector3d> points_;
  std::span<const std::array<Index, 3>> triangles_;
  std::span<const std::array<Index, 4>> quads_;
  ElementSides sides_;
  MeshNormals normals_;
};

/// Calls ask(corners) for an element, a triangle or a quad, as both are numbered together.
template <class Ask>
bool with_corners(const QuadMesh& mesh, Index element, const Ask& ask) {
  const auto triangles = Index(mesh.triangles.size());
  return element < triangles ? ask(corners_of<3>(mesh.points, mesh.triangles[element]))
                             : ask(corners_of<4>(mesh.points, mesh.quads[element - triangles]));
}

template <std::size_t N>
bool is_folded_under(const Result& result, Index element, const Corners<N>& p, std::span<const char> unsure) {
  return space::is_folded_under(result.surface(), result.normals(), p, result.triangle(element), unsure);
}

std::optional<Defect> find_turned(const Result& result, const std::vector<Suspect>& suspects,
                                  std::span<const char> unsure) {
  const QuadMesh& mesh = result.mesh();
  const auto is_excused = [&](Index e) {
    return with_corners(mesh, e, [&](const auto& p) { return is_folded_under(result, e, p, unsure); });
  };
  for (const auto& [e, has_bad_corner] : suspects)
    if (has_bad_corner || !is_excused(e))
      return defect_at("an element is turned over among its neighbours", mesh.points[result.sides().node(4 * e)]);
  return {};
}

/// What an element is held against.
struct Ground {
  const Result& result;
  std::span<const char> unsure;
  double beside;
  const TriangleTree* other_halves = nullptr;  ///< Reference::other_halves() of quads that were free to change
};

/// Squared: how long the longest side of a triangle is. A facet of a coarse surface stands off it in proportion.
double longest_side2(const Background& surface, Index t) {
  double longest = 0;
  for (int i = 0; i < 3; ++i)
    longest = std::max(longest, (surface.corner(t, (i + 1) % 3) - surface.corner(t, i)).squaredNorm());
  return longest;
}

bool is_beside(const Ground& ground, Index element, Index node, double length2) {
  const Result& result = ground.result;
  const Foot foot = result.foot(element, node);
  const double most = ground.beside * ground.beside * std::max(length2, longest_side2(result.surface(), foot.triangle));
  if (foot.distance2 <= most) return false;
  return !ground.other_halves || !(ground.other_halves->closest(result.mesh().points[node]).distance2 <= most);
}

template <std::size_t N>
std::optional<Defect> look_at(const Ground& ground, Index element, const std::array<Index, N>& nodes) {
  const Result& result = ground.result;
  const Corners<N> p = corners_of<N>(result.mesh().points, nodes);
  const std::size_t corner = bad_corner(result.sines(element, p, nodes));
  if (corner < N && !is_folded_under(result, element, p, ground.unsure) &&
      !is_on_unsure_ground(result, element, p, ground.unsure))
    return defect_at("an element has a corner that is not convex", p[corner]);
  for (std::size_t i = 0; i < N; ++i) {
    const Index row = result.mesh().source[nodes[i]];
    if (row != kNone && result.surface().point(row) == p[i]) continue;
    if (is_beside(ground, element, nodes[i], (p[(i + 1) % N] - p[i]).squaredNorm()))
      return defect_at("a node has left the surface", p[i]);
  }
  return {};
}

/// The centre, and a point near each corner.
template <std::size_t N>
std::vector<Vector3d> points_inside(const Corners<N>& p) {
  constexpr double kInwards = 0.25;  // of the way to the centre
  Vector3d centre = Vector3d::Zero();
  for (const Vector3d& corner : p) centre += corner / double(N);
  std::vector<Vector3d> points{centre};
  for (const Vector3d& corner : p) points.emplace_back(corner + kInwards * (centre - corner));
  return points;
}

}  // namespace

template <std::size_t N>
bool is_folded_under(const Background& surface, const SurfaceNormals& normals, const Corners<N>& p, Index hint,
                     std::span<const char> unsure) {
  std::set<Index> near;
  const auto add = [&](const Vector3d& point) {
    const Index t = normals.closest(point, hint).triangle;
    near.insert(t);
    for (int i = 0; i < 3; ++i)
      if (surface.neighbour(t, i) != kNone) near.insert(surface.neighbour(t, i));
  };
  const auto is_unsure = [&](Index t) { return !unsure.empty() && unsure[t]; };
  for (const Vector3d& point : points_inside(p)) add(point);
  return std::any_of(near.begin(), near.end(), [&](Index t) {
    for (int i = 0; i < 3 && !is_unsure(t); ++i)
      if (const Index other = surface.neighbour(t, i);
          near.contains(other) && !is_unsure(other) && are_folded(surface, t, other))
        return true;
    return false;
  });
}

template bool is_folded_under(const Background&, const SurfaceNormals&, const Corners<3>&, Index,
                              std::span<const char>);
template bool is_folded_under(const Background&, const SurfaceNormals&, const Corners<4>&, Index,
                              std::span<const char>);

template <std::size_t N>
bool is_on_unsure_ground(const Result& result, Index element, const Corners<N>& p, std::span<const char> unsure) {
  if (unsure.empty()) return false;
  const std::vector<Vector3d> points = points_inside(p);
  return std::any_of(points.begin(), points.end(), [&](const Vector3d& point) {
    const Index t = result.normals().closest(point, result.triangle(element)).triangle;
    bool found = unsure[t];
    for (int i = 0; i < 3; ++i)
      if (const Index other = result.surface().neighbour(t, i); other != kNone) found = found || unsure[other];
    return found;
  });
}

template bool is_on_unsure_ground(const Result&, Index, const Corners<3>&, std::span<const char>);
template bool is_on_unsure_ground(const Result&, Index, const Corners<4>&, std::span<const char>);

namespace {

bool is_on_unsure_ground(const Result& result, Index element, std::span<const char> unsure) {
  return with_corners(result.mesh(), element,
                      [&](const auto& p) { return is_on_unsure_ground(result, element, p, unsure); });
}

}  // namespace

std::vector<char> bad_elements(const Patch& patch) {
  const Neighbourhood elements(patch.points, patch.triangles, patch.quads, patch.constraints);
  const Reference reference(patch);
  const auto triangles = Index(patch.triangles.size());
  std::vector<char> bad(elements.elements(), 0);
  for (Index e = 0; e < bad.size(); ++e) {
    bad[e] = elements.has_bad_corner(e) || elements.folds(e) > 1;  // a surface that is folded is so at one side
    if (const Index half = triangles + 2 * (e - triangles);
        e >= triangles && are_folded(reference.surface, half, half + 1))
      bad[e] = 1;
  }
  return bad;
}

namespace {

std::vector<char> on_bad_elements(const Patch& patch) {
  const std::vector<char> is_bad = bad_elements(patch);
  if (!is_any(is_bad)) return {};
  std::vector<char> unsure;
  for (const char bad : is_bad) unsure.insert(unsure.end(), unsure.size() < patch.triangles.size() ? 1 : 2, bad);
  return unsure;
}

}  // namespace

std::vector<char> unsure_ground(const Patch& patch) {
  return patch.quads.empty() ? std::vector<char>() : on_bad_elements(patch);
}

std::vector<Suspect> find_suspects(const Patch& before, const QuadMesh& after, std::size_t kept) {
  const auto constraints = kept_constraints(before, after);
  const Neighbourhood elements(after.points, after.triangles, after.quads, constraints);
  std::vector<Suspect> suspects;
  for (Index e = 0; e < elements.elements(); ++e)
    if (e >= after.triangles.size() && e < after.triangles.size() + kept)
      continue;
    else if (const bool is_bad = elements.has_bad_corner(e); is_bad || elements.folds(e) > 0)
      suspects.push_back({e, is_bad});
  return suspects;
}

std::optional<Defect> find_turned(const Patch& before, const QuadMesh& after, std::size_t kept,
                                  std::vector<Suspect> suspects) {
  if (suspects.empty()) return {};
  const std::vector<char> unsure = on_bad_elements(before);
  const bool are_triangles = kept == before.quads.size();
  if (are_triangles && unsure.empty()) return {};
  const Result result(before, after);
  if (are_triangles)
    std::erase_if(suspects, [&](const Suspect& s) { return !is_on_unsure_ground(result, s.element, unsure); });
  return find_turned(result, suspects, unsure);
}

std::optional<Defect> find_defect(const Patch& before, const Result& result, std::size_t kept, double beside) {
  const QuadMesh& after = result.mesh();
  const bool are_free = kept == 0 && !before.quads.empty();
  const std::vector<char> unsure = are_free ? unsure_ground(before) : std::vector<char>();
  Ground ground{result, unsure, beside};
  const auto halves = are_free ? Reference::other_halves(before) : std::vector<Background::Triangle>();
  std::optional<TriangleTree> other_halves;
  if (!halves.empty()) ground.other_halves = &other_halves.emplace(before.points, halves);
  const Index triangles = Index(after.triangles.size());
  for (Index t = 0; t < triangles; ++t)
    if (auto defect = look_at(ground, t, after.triangles[t])) return defect;
  for (Index q = Index(kept); q < after.quads.size(); ++q)
    if (auto defect = look_at(ground, triangles + q, after.quads[q])) return defect;
  if (are_free)
    if (auto defect = find_turned(result, find_suspects(before, after, kept), unsure)) return defect;
  if (characteristic(before.points.size(), before.triangles, before.quads) !=
      characteristic(after.points.size(), after.triangles, after.quads))
    return Defect{"a handle or a hole has come or gone", {}};
  return {};
}

Index find_bad_quad(const Patch& patch, Index& corner) {
  const Neighbourhood elements(patch.points, patch.triangles, patch.quads, patch.constraints);
  for (Index q = 0; q < patch.quads.size(); ++q) {
    const std::size_t k = elements.bad_corner_of_quad(q);
    if (k == 4) continue;
    corner = patch.quads[q][k];
    return q;
  }
  return kNone;
}

}  // namespace qmorph::space
