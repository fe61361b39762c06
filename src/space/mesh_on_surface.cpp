// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/mesh_on_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace qmorph::space {
namespace {

using Eigen::Vector3d;

/// A unit vector across another one.
Vector3d across(const Vector3d& normal) {
  const Vector3d axis = std::abs(normal.x()) < 0.6 ? Vector3d::UnitX() : Vector3d::UnitY();
  return (axis - axis.dot(normal) * normal).normalized();
}

/// The axes of a plane, turned as the plane's normal is turned into another one by the shortest way.
struct TurnedAxes {
  Vector3d u, v;

  TurnedAxes(const Vector3d& from, const Vector3d& to, const UnfoldedStar& star) {
    // Of a rotation that brings `from` to `to` the transpose brings the axes of the plane to those of the element.
    const Vector3d axis = to.cross(from);
    const double cosine = from.dot(to);
    const auto turned = [&](const Vector3d& w) -> Vector3d {
      return cosine * w + axis.cross(w) + axis.dot(w) / (1 + cosine) * axis;
    };
    u = turned(star.axis_u), v = turned(star.axis_v);
  }
  Vec2 operator()(const Vector3d& w) const { return {w.dot(u), w.dot(v)}; }
};

/// Corner and triangle, by corner.
std::vector<std::pair<Index, Index>> triangles_by_corner(const Background& surface) {
  std::vector<std::pair<Index, Index>> triangles;
  triangles.reserve(3 * surface.triangles());
  for (Index t = 0; t < surface.triangles(); ++t)
    for (Index v : surface.corners(t)) triangles.emplace_back(v, t);
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace

template <std::size_t N>
Corners<N> MeshOnSurface::corners(const Face& face) const {
  Corners<N> corners;
  for (std::size_t i = 0; i < N; ++i) corners[i] = mesh_.points[face[i]];
  return corners;
}

template <std::size_t N>
CornerNormals<N> MeshOnSurface::normals(Index f) const {
  const Face& face = mesh_.faces[f];
  CornerNormals<N> normals{{}, Vector3d::Zero()};
  for (std::size_t i = 0; i < N; ++i)
    normals.whole += normals.at[i] = is_on_crease_[face[i]] ? surface_.normal_near(mesh_.near[f]) : normal_[face[i]];
  return normals;
}

MeshOnSurface::MeshOnSurface(Mesh& mesh, const std::vector<std::pair<Index, Index>>& creases, const Background& surface,
                             WholeSurface whole, std::span<const char> stretched)
    : mesh_(mesh),
      surface_(surface),
      whole_(std::move(whole)),
      stretched_(stretched),
      opposite_(chart::opposite_sides(mesh)),
      first_side_(mesh.points.size(), kNone),
      is_free_(mesh.points.size(), 0),
      is_on_crease_(mesh.points.size(), 0),
      normal_(mesh.points.size(), Vector3d::Zero()) {
  cut(creases);
  for (Index v = 0; v < nodes(); ++v) is_free_[v] = !mesh.fixed[v];
  for (Index f = 0; f < faces(); ++f)
    for (Index i = 0; i < chart::degree(mesh.faces[f]); ++i) {
      const Index side = 4 * f + i, v = node(side);
      if (first_side_[v] == kNone || opposite_[side] == kNone) first_side_[v] = side;
      if (opposite_[side] == kNone) is_free_[v] = is_free_[node(next(side))] = 0;
    }
  for (Index v = 0; v < nodes(); ++v) {
    if (first_side_[v] == kNone || is_on_crease_[v]) continue;
    const Foot foot = surface.foot_on(mesh.on[v], mesh.points[v]);
    normal_[v] = surface.smooth_normal(foot.triangle, foot.weights);
  }
  if (!creases.empty()) find_places();
}

void MeshOnSurface::cut(const std::vector<std::pair<Index, Index>>& creases) {
  if (creases.empty()) return;
  for (const auto& [a, b] : creases) is_on_crease_[a] = is_on_crease_[b] = 1;
  for (Index f = 0; f < faces(); ++f)
    for (Index side = 4 * f; side < 4 * f + chart::degree(mesh_.faces[f]); ++side) {
      const Index a = node(side), b = node(next(side));
      if (opposite_[side] == kNone || !is_on_crease_[a] || !is_on_crease_[b]) continue;
      if (!std::binary_search(creases.begin(), creases.end(), std::pair<Index, Index>(std::minmax(a, b)))) continue;
      opposite_[opposite_[side]] = kNone;
      opposite_[side] = kNone;
    }
}

Vector3d MeshOnSurface::normal_of(Index f) const {
  const Face& face = mesh_.faces[f];
  return chart::degree(face) == 4 ? element_normal(corners<4>(face)) : element_normal(corners<3>(face));
}

Vector3d MeshOnSurface::centre(Index f) const {
  Vector3d sum = Vector3d::Zero();
  const Index degree = chart::degree(mesh_.faces[f]);
  for (Index i = 0; i < degree; ++i) sum += point(mesh_.faces[f][i]);
  return sum / double(degree);
}

/// Nodes on creases have triangles on several sides: faces there are found from a node that is elsewhere, or from a
/// neighbour.
void MeshOnSurface::find_places() {
  std::vector<Index> queue;
  std::vector<char> found(faces(), 0);
  const auto place = [&](Index f, Index hint) {
    mesh_.near[f] = surface_.walk(centre(f), hint).triangle;
    found[f] = 1;
    queue.push_back(f);
  };
  for (Index f = 0; f < faces(); ++f)
    for (Index i = 0; i < chart::degree(mesh_.faces[f]) && !found[f]; ++i)
      if (const Index v = mesh_.faces[f][i]; !is_on_crease_[v]) place(f, mesh_.on[v]);
  const auto spread = [&] {
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (Index side = 4 * queue[k]; side < 4 * queue[k] + chart::degree(mesh_.faces[queue[k]]); ++side)
        if (opposite_[side] != kNone && !found[opposite_[side] / 4]) place(opposite_[side] / 4, mesh_.near[side / 4]);
    queue.clear();
  };
  spread();
  if (std::all_of(found.begin(), found.end(), [](char is) { return is; })) return;
  const auto triangles_at = triangles_by_corner(surface_);
  for (Index f = 0; f < faces(); ++f) {
    if (found[f]) continue;
    Foot best = surface_.foot_on(mesh_.near[f], centre(f));
    bool best_is_alike = false;
    const Vector3d own = normal_of(f);
    for (Index i = 0; i < chart::degree(mesh_.faces[f]); ++i) {
      const std::pair<Index, Index> start(mesh_.faces[f][i], 0);
      auto it = std::lower_bound(triangles_at.begin(), triangles_at.end(), start);
      for (; it != triangles_at.end() && it->first == start.first; ++it) {
        const Foot foot = surface_.foot_on(it->second, centre(f));
        const bool is_alike = surface_.normal(it->second).dot(own) > 0;
        if (is_alike == best_is_alike ? foot.distance2 < best.distance2 : is_alike)
          best = foot, best_is_alike = is_alike;
      }
    }
    place(f, best.triangle);
    spread();
  }
}

double MeshOnSurface::smallest_sine(Index f) const {
  const Face& face = mesh_.faces[f];
  return chart::degree(face) == 4 ? scaled_jacobian(corners<4>(face), normals<4>(f))
                                  : scaled_jacobian(corners<3>(face), normals<3>(f));
}

std::optional<double> MeshOnSurface::clear_sine(Index f) const {
  const Face& face = mesh_.faces[f];
  double cosine = 0;
  for (Index i = 0; i < chart::degree(face); ++i) cosine = std::max(cosine, whole_.clear_cosine(mesh_.on[face[i]]));
  if (cosine > 1) return {};
  return chart::degree(face) == 4 ? clear_jacobian(corners<4>(face), normals<4>(f), cosine)
                                  : clear_jacobian(corners<3>(face), normals<3>(f), cosine);
}

bool MeshOnSurface::is_clearly_above(Index f, double sine) const {
  const std::optional<double> clear = clear_sine(f);
  return clear && *clear > sine;
}

double MeshOnSurface::sure_sine(Index f) const {
  const std::optional<double> clear = clear_sine(f);
  return clear ? *clear : exact_sine(f);
}

double MeshOnSurface::exact_sine(Index f) const {
  if (exact_.empty()) exact_.assign(faces(), kUnknown);
  if (exact_[f] == kUnknown) exact_[f] = look_closely(f);
  return exact_[f];
}

double MeshOnSurface::look_closely(Index f) const {
  ++exact_looks_;
  const Face& face = mesh_.faces[f];
  const auto sine = [&](const auto& p) {
    return scaled_jacobian(p, whole_.normals().of(p, whole_.row(mesh_.near[f])));
  };
  return chart::degree(face) == 4 ? sine(corners<4>(face)) : sine(corners<3>(face));
}

double MeshOnSurface::exact_rise(Index f) const {
  const Face& face = mesh_.faces[f];
  const auto rise = [&](const auto& p) { return smallest_rise(p, whole_.normals().of(p, whole_.row(mesh_.near[f]))); };
  return chart::degree(face) == 4 ? rise(corners<4>(face)) : rise(corners<3>(face));
}

double MeshOnSurface::smallest_sine_around(Index v) const {
  double least = 1;
  for_sides_around(v, [&](Index side) { least = std::min(least, smallest_sine(side / 4)); });
  return least;
}

bool MeshOnSurface::unfold(Index v, UnfoldedStar& star) const {
  constexpr double kLeastCosine = -0.5;
  const Vector3d &centre = mesh_.points[v], &normal = normal_[v];
  if (normal.isZero()) return false;
  star.axis_u = across(normal);
  star.axis_v = normal.cross(star.axis_u);
  star.elements.clear();
  star.edge = 0;
  bool is_good = true;
  for_sides_around(v, [&](Index side) {
    const Face& face = mesh_.faces[side / 4];
    const bool is_quad = chart::degree(face) == 4;
    const Index q = node(next(side)), r = node(previous(side)), o = is_quad ? node(next(next(side))) : kNone;
    Vector3d own = normal_of(side / 4);
    if (own.isZero()) own = normal;
    if (own.dot(normal) < kLeastCosine) is_good = false;
    const TurnedAxes laid(own, normal, star);
    smoothing::StarElement element;
    element.q = laid(mesh_.points[q] - centre);
    element.r = laid(mesh_.points[r] - centre);
    element.after_q = is_quad ? laid(mesh_.points[o] - centre) : element.r;
    element.before_r = is_quad ? element.after_q : element.q;
    element.node = q, element.opposite = is_quad ? o : q;
    star.edge += element.q.norm();
    star.elements.push_back(element);
  });
  star.edge /= double(star.elements.size());
  return is_good;
}

void MeshOnSurface::move(Index v, const Foot& foot) {
  mesh_.points[v] = foot.point;
  mesh_.on[v] = foot.triangle;
  normal_[v] = surface_.smooth_normal(foot.triangle, foot.weights);
  forget_exact(v);
}

}  // namespace qmorph::space
