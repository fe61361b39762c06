// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/pillow.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "chart/surface_mesh.hpp"
#include "qmorph/options.hpp"
#include "space/mesh_on_surface.hpp"
#include "space/smooth.hpp"

namespace qmorph::space {
namespace {

using Eigen::Vector3d;

class Pillow {
 public:
  Pillow(const Patch& before, const Result& result, std::span<const Index> quads)
      : before_(before),
        result_(result),
        sides_(result.sides()),
        quads_(quads),
        is_inside_(sides_.elements(), 0),
        mesh_(result.mesh()) {
    for (const Index q : quads) is_inside_[element(q)] = 1;
  }

  QuadMesh run() {
    shrink();
    place();
    surround();
    smooth_there();
    return std::move(mesh_);
  }

 private:
  Index element(Index quad) const { return Index(mesh_.triangles.size()) + quad; }
  /// Whether another of the quads lies behind the side.
  bool is_shared(Index side) const {
    const Index opposite = sides_.opposite(side);
    return opposite != kNone && is_inside_[opposite / 4];
  }

  /// Calls visit(side) for this side and those that start at the same node in others of the quads, joined through
  /// their sides around there. True if they go all the way round.
  template <class Visit>
  bool for_joined(Index side, const Visit& visit) const {
    Index s = side;
    while (is_shared(s)) {  // clockwise
      s = sides_.next(sides_.opposite(s));
      if (s == side) break;
    }
    const bool closed = s == side && is_shared(side);
    const Index first = s;
    do {
      visit(s);
      if (!is_shared(sides_.previous(s))) break;
      s = sides_.opposite(sides_.previous(s));
    } while (s != first);
    return closed;
  }

  /// Gives the quads a node of their own in place of each that they share with others or that lies on the boundary.
  void shrink() {
    own_.assign(4 * quads_.size(), kNone);
    std::vector<Index> at(sides_.slots(), kNone);  // by side: its place in own_
    for (std::size_t i = 0; i < quads_.size(); ++i)
      for (Index k = 0; k < 4; ++k) at[4 * element(quads_[i]) + k] = Index(4 * i) + k;
    for (std::size_t i = 0; i < own_.size(); ++i) {
      if (own_[i] != kNone) continue;
      const Index side = 4 * element(quads_[i / 4]) + Index(i % 4);
      std::vector<Index> joined;
      const bool is_within = for_joined(side, [&](Index other) { joined.push_back(other); });
      const Index node = is_within ? sides_.node(side) : Index(mesh_.points.size());
      if (!is_within) {
        mesh_.points.push_back(result_.mesh().points[sides_.node(side)]);
        mesh_.source.push_back(kNone);
        corners_.push_back(joined);
      }
      for (const Index other : joined) own_[at[other]] = node;
    }
    for (std::size_t i = 0; i < own_.size(); ++i) mesh_.quads[quads_[i / 4]][i % 4] = own_[i];
  }

  /// Half of the way to the middles of the quads that a new node is of.
  void place() {
    constexpr double kWay = 0.5;
    const std::size_t first = mesh_.points.size() - corners_.size();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      Vector3d middle = Vector3d::Zero();
      for (const Index side : corners_[i]) middle += centre(side / 4) / double(corners_[i].size());
      Vector3d& point = mesh_.points[first + i];
      const Index hint = result_.triangle(corners_[i][0] / 4);
      point = foot_of(point + kWay * (middle - point), hint);
    }
  }

  Vector3d foot_of(const Vector3d& point, Index hint) const {
    const Foot foot = result_.normals().closest(point, hint);
    Vector3d there = Vector3d::Zero();
    for (int i = 0; i < 3; ++i) there += foot.weights[i] * result_.surface().corner(foot.triangle, i);
    return there;
  }

  Vector3d centre(Index element) const {
    Vector3d sum = Vector3d::Zero();
    for (Index k = 0; k < 4; ++k) sum += 0.25 * result_.mesh().points[sides_.node(4 * element + k)];
    return sum;
  }

  void surround() {
    for (std::size_t i = 0; i < own_.size(); ++i) {
      const Index side = 4 * element(quads_[i / 4]) + Index(i % 4);
      if (is_shared(side)) continue;
      const Index next = own_[i % 4 == 3 ? i - 3 : i + 1];
      mesh_.quads.push_back({sides_.node(side), sides_.target(side), next, own_[i]});
      parents_.push_back(side / 4);
    }
  }

  /// The new nodes, and those around that may move.
  void smooth_there() {
    chart::SurfaceMesh mesh = as_surface_mesh();
    std::vector<Index> nodes(corners_.size());
    std::iota(nodes.begin(), nodes.end(), Index(mesh_.points.size() - corners_.size()));
    MeshOnSurface view(mesh, {}, result_.surface(), result_.surface());
    smooth_near(view, SmoothingOptions(), nodes);
    mesh_.points = std::move(mesh.points);
  }

  chart::SurfaceMesh as_surface_mesh() const {
    chart::SurfaceMesh mesh;
    mesh.points = mesh_.points;
    mesh.on.assign(mesh.points.size(), kNone);
    mesh.node.resize(mesh.points.size());
    std::iota(mesh.node.begin(), mesh.node.end(), Index(0));
    mesh.fixed = fixed_nodes();
    const ElementSides sides(mesh.points.size(), mesh_.triangles, mesh_.quads, kept_constraints(before_, mesh_));
    mesh.open.assign(sides.slots(), false);
    for (Index e = 0; e < sides.elements(); ++e) {
      mesh.near.push_back(result_.triangle(e < sides_.elements() ? e : parents_[e - sides_.elements()]));
      mesh.faces.emplace_back();
      for (Index side = 4 * e; side < 4 * e + 4; ++side) {
        const Index v = mesh.faces.back()[side % 4] = sides.node(side);
        if (v == kNone) continue;
        if (mesh.on[v] == kNone) mesh.on[v] = result_.normals().closest(mesh.points[v], mesh.near[e]).triangle;
        if (sides.opposite(side) == kNone) {
          mesh.open[side] = true;
          mesh.fixed[v] = mesh.fixed[sides.target(side)] = 1;
        }
      }
    }
    const Index first = Index(mesh.points.size() - corners_.size());
    for (Index v = 0; v < first; ++v)  // it may lie on a crease
      if (mesh.on[v] != kNone && !result_.surface().is_smooth(mesh.on[v])) mesh.fixed[v] = 1;
    return mesh;
  }

  std::vector<char> fixed_nodes() const {
    std::vector<char> is_fixed_row(before_.points.size(), 0), is_fixed(mesh_.points.size(), 0);
    for (const Index row : before_.fixed) is_fixed_row[row] = 1;
    for (Index v = 0; v < mesh_.source.size(); ++v)
      is_fixed[v] = mesh_.source[v] != kNone && is_fixed_row[mesh_.source[v]];
    return is_fixed;
  }

  const Patch& before_;
  const Result& result_;
  const ElementSides& sides_;
  const std::span<const Index> quads_;
  std::vector<char> is_inside_;  ///< by element
  QuadMesh mesh_;
  std::vector<Index> own_;                   ///< node of each corner of the quads, four by four
  std::vector<std::vector<Index>> corners_;  ///< of each new node: the sides that start at it
  std::vector<Index> parents_;               ///< of the new quads: the element that has shrunk
};

}  // namespace

QuadMesh pillow(const Patch& before, const Result& result, std::span<const Index> quads) {
  return Pillow(before, result, quads).run();
}

}  // namespace qmorph::space
