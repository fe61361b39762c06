// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <map>
#include <optional>

#include "chart/chart.hpp"
#include "chart/rework.hpp"
#include "cleanup/repair.hpp"
#include "kernel/sort_unique.hpp"
#include "smoothing/smooth.hpp"
#include "space/repair.hpp"

namespace qmorph::space {
namespace {

using chart::Chart;
using chart::Piece;
using chart::SurfaceMesh;
using Eigen::Vector3d;

constexpr Index kMostFaces = 400;  ///< of a piece

/// Faces and `rings` rings around them.
std::vector<Index> grow(const MeshOnSurface& mesh, std::vector<Index> faces, int rings) {
  sort_unique(faces);
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t count = faces.size();
    for (std::size_t k = 0; k < count; ++k)
      for (Index i = 0; i < chart::degree(mesh.mesh().faces[faces[k]]); ++i)
        mesh.for_sides_around(mesh.node(4 * faces[k] + i), [&](Index side) { faces.push_back(side / 4); });
    sort_unique(faces);
  }
  return faces;
}

/// The connected parts of a set of faces, in the order of their first faces. `faces` is sorted.
std::vector<std::vector<Index>> components(const MeshOnSurface& mesh, const std::vector<Index>& faces) {
  std::vector<char> seen(faces.size(), 0);
  const auto place = [&](Index f) {
    return std::size_t(std::lower_bound(faces.begin(), faces.end(), f) - faces.begin());
  };
  std::vector<std::vector<Index>> parts;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (seen[k]) continue;
    std::vector<Index> part{faces[k]};
    seen[k] = 1;
    for (std::size_t i = 0; i < part.size(); ++i)
      for (Index side = 4 * part[i]; side < 4 * part[i] + chart::degree(mesh.mesh().faces[part[i]]); ++side) {
        if (mesh.opposite(side) == kNone) continue;
        const Index other = mesh.opposite(side) / 4;
        const std::size_t at = place(other);
        if (at == faces.size() || faces[at] != other || seen[at]) continue;
        seen[at] = 1;
        part.push_back(other);
      }
    std::sort(part.begin(), part.end());
    parts.push_back(std::move(part));
  }
  return parts;
}

/// The triangles of the surface under some faces, with rings around, laid flat.
class Ground {
 public:
  Ground(const SurfaceMesh& triangles, const std::vector<Index>& opposite, const MeshOnSurface& mesh,
         const std::vector<Index>& faces)
      : piece_(triangles, opposite, {}, triangles_under(mesh, faces)), chart_(piece_) {
    for (Index k = 0; k < piece_.row.size(); ++k) half_of_[piece_.row[k]] = piece_.first_half[k];
  }

  const Chart& chart() const { return chart_; }
  bool is_good() const {
    constexpr double kMostDistortion = 2;
    return piece_.boundary_sides > 0 && chart_.flattening().flipped == 0 &&
           chart_.flattening().distortion < kMostDistortion;
  }

  /// Where a point of a triangle of the surface lies in the chart, if it does.
  std::optional<Vec2> lay(const Background& surface, Index triangle, const Vector3d& p) const {
    const auto half = half_of_.find(triangle);
    if (half == half_of_.end()) return {};
    const Foot foot = surface.foot_on(triangle, p);
    Vec2 flat = Vec2::Zero();
    for (int i = 0; i < 3; ++i) flat += foot.weights[i] * chart_.flat()[piece_.halves[half->second][i]];
    return flat;
  }

  /// The way back; the point lies in the triangle of the surface that is returned.
  std::pair<Vector3d, Index> lift(const Vec2& p, Index near_triangle) const {
    const auto hint = half_of_.find(near_triangle);
    const Chart::Place place = chart_.locate(p, hint == half_of_.end() ? 0 : hint->second);
    return {chart_.to_space(place), piece_.row[place.half]};
  }

 private:
  static std::vector<Index> triangles_under(const MeshOnSurface& mesh, const std::vector<Index>& faces) {
    constexpr int kRings = 2;
    const Background& surface = mesh.surface();
    std::vector<Index> triangles;
    for (Index f : faces) {
      Vector3d centre = Vector3d::Zero();
      const Index degree = chart::degree(mesh.mesh().faces[f]);
      for (Index i = 0; i < degree; ++i) centre += mesh.point(mesh.node(4 * f + i)) / double(degree);
      triangles.push_back(surface.walk(centre, mesh.mesh().near[f]).triangle);
      for (Index i = 0; i < degree; ++i) {
        const Index v = mesh.node(4 * f + i);
        triangles.push_back(mesh.mesh().on[v]);
        const Vector3d middle = 0.5 * (mesh.point(v) + mesh.point(mesh.node(mesh.next(4 * f + i))));
        for (const Vector3d& p : {Vector3d(0.5 * (mesh.point(v) + centre)), middle})
          triangles.push_back(surface.walk(p, mesh.mesh().on[v]).triangle);
      }
    }
    for (int ring = 0; ring < kRings; ++ring) {
      sort_unique(triangles);
      const std::size_t count = triangles.size();
      for (std::size_t k = 0; k < count; ++k)
        for (int i = 0; i < 3; ++i)
          if (const Index other = surface.neighbour(triangles[k], i); other != kNone) triangles.push_back(other);
    }
    sort_unique(triangles);
    return triangles;
  }

  Piece piece_;
  Chart chart_;
  std::map<Index, Index> half_of_;  ///< by triangle of the surface
};

bool is_valid(const kernel::Mesh& mesh) {
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f) && !mesh.is_valid_face(f)) return false;
  return true;
}

/// Untangles the mesh in its plane; false if an element stays turned over.
bool untangle(kernel::Mesh& mesh, const SmoothingOptions& options) {
  std::vector<Index> nodes;
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v)) nodes.push_back(v);
  smoothing::smooth_near(mesh, options, nodes, 0);
  cleanup::repair(mesh, options);
  return is_valid(mesh);
}

class Mender {
 public:
  Mender(SurfaceMesh mesh, const std::vector<chart::Edge>& creases, const chart::CurvedRegion& region,
         const Background& surface, const SmoothingOptions& options)
      : mesh_(std::move(mesh)),
        creases_(creases),
        triangles_(region.triangles()),
        surface_(surface),
        whole_(region.whole()),
        options_(options) {
    opposite_.assign(4 * triangles_.faces.size(), kNone);
    for (Index side = 0; side < 3 * surface.triangles(); ++side)
      if (const Index other = surface.opposite(side); other != kNone)
        opposite_[4 * (side / 3) + side % 3] = 4 * (other / 3) + other % 3;
  }

  /// Adds what it has cost to `work`.
  SurfaceMesh run(std::size_t& work) {
    constexpr int kFewestRings = 2, kMostRings = 4;
    for (int rings = kFewestRings; rings <= kMostRings && has_work(); rings += 2)
      if (!mend(rings)) break;
    work += spent_;
    return std::move(mesh_);
  }

 private:
  /// Where everything is turned over, the fault is not one that is mended here.
  bool has_work() const {
    constexpr std::size_t kEach = 500, kFew = 1'000'000;  // of a face, and for few
    return spent_ < kFew + kEach * mesh_.faces.size();
  }

  /// False if nothing is left to do.
  bool mend(int rings) {
    MeshOnSurface view(mesh_, creases_, surface_, whole_);
    std::vector<Index> bad;
    for (const PoorFace& poor : find_poor(view, 0)) bad.push_back(poor.face);
    if (bad.empty()) return false;
    std::vector<std::unique_ptr<Piece>> pieces;
    std::vector<chart::Reworked> done;
    for (const std::vector<Index>& faces : components(view, grow(view, bad, rings))) {
      if (faces.size() > kMostFaces) continue;
      if (!has_work()) break;
      pieces.push_back(std::make_unique<Piece>(mesh_, opposites(view), std::vector<bool>{}, faces));
      if (auto work = rework(view, *pieces.back(), faces)) done.push_back(std::move(*work));
    }
    if (!done.empty()) mesh_ = chart::replace_where_simple(mesh_, std::move(done));
    return true;
  }

  std::vector<Index> opposites(const MeshOnSurface& view) const {
    std::vector<Index> opposite(4 * view.faces());
    for (Index side = 0; side < opposite.size(); ++side) opposite[side] = view.opposite(side);
    return opposite;
  }

  std::optional<chart::Reworked> rework(const MeshOnSurface& view, const Piece& piece,
                                        const std::vector<Index>& faces) {
    constexpr std::size_t kWorkToLayOut = 1500;  // of a face: the triangles under it, and some around
    if (piece.boundary_sides == 0) return {};
    spent_ += kWorkToLayOut * faces.size();
    const Ground ground(triangles_, opposite_, view, faces);
    spent_ += ground.chart().flattening().work;
    if (!ground.is_good()) return {};
    std::vector<Vec2> flat;
    for (Index v = 0; v < piece.points.size(); ++v) {
      const auto p = ground.lay(surface_, piece.on[v], piece.points[v]);
      if (!p) return {};
      flat.push_back(*p);
    }
    chart::Reworked work{&piece, piece.mesh(flat), {}};
    const bool is_good = untangle(work.mesh, options_);
    spent_ += work.mesh.work();
    if (!is_good || chart::folds_onto_itself(work.mesh, piece)) return {};
    work.lifted = lift(work.mesh, piece, flat, ground);
    if (count_bad(work) >= count_bad(view, faces)) return {};
    return work;
  }

  chart::Lifted lift(const kernel::Mesh& mesh, const Piece& piece, const std::vector<Vec2>& flat,
                     const Ground& ground) const {
    chart::Lifted lifted{std::vector<Vector3d>(mesh.vertex_slots(), Vector3d::Zero()),
                         std::vector<Index>(mesh.vertex_slots(), kNone)};
    Index near = piece.on[0];
    for (Index v = 0; v < mesh.vertex_slots(); ++v) {
      if (!mesh.is_live_vertex(v)) continue;
      if (v < piece.points.size() && mesh.point(v) == flat[v])
        lifted.points[v] = piece.points[v], lifted.on[v] = piece.on[v];
      else
        std::tie(lifted.points[v], lifted.on[v]) =
            ground.lift(mesh.point(v), v < piece.points.size() ? piece.on[v] : near);
      near = lifted.on[v];
    }
    return lifted;
  }

  std::size_t count_bad(const MeshOnSurface& view, const std::vector<Index>& faces) const {
    return std::size_t(std::count_if(faces.begin(), faces.end(), [&](Index f) { return !(view.exact_sine(f) > 0); }));
  }

  std::size_t count_bad(const chart::Reworked& work) const {
    SurfaceMesh part;
    part.points = work.lifted.points;
    part.on = work.lifted.on;
    part.fixed.assign(part.points.size(), 0);
    for (Index f = 0; f < work.mesh.face_slots(); ++f) {
      if (!work.mesh.is_live_face(f)) continue;
      chart::Face face{kNone, kNone, kNone, kNone};
      Index i = 0;
      work.mesh.for_nodes_of(f, [&](Index v) { face[i++] = v; });
      part.faces.push_back(face);
      part.near.push_back(part.on[face[0]]);
    }
    part.open.assign(4 * part.faces.size(), false);
    return find_poor(MeshOnSurface(part, {}, surface_, whole_), 0).size();
  }

  SurfaceMesh mesh_;
  const std::vector<chart::Edge>& creases_;
  const SurfaceMesh triangles_;  ///< the surface itself
  std::vector<Index> opposite_;  ///< of their sides
  const Background& surface_;
  const WholeSurface whole_;
  const SmoothingOptions& options_;
  std::size_t spent_ = 0;
};

}  // namespace

SurfaceMesh mend_in_charts(SurfaceMesh mesh, const std::vector<chart::Edge>& creases, const chart::CurvedRegion& region,
                           const Background& surface, const SmoothingOptions& options, std::size_t& work) {
  return Mender(std::move(mesh), creases, region, surface, options).run(work);
}

}  // namespace qmorph::space
