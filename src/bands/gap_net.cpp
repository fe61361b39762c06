// SPDX-License-Identifier: GPL-2.0-or-later
#include "bands/gap_net.hpp"

#include <numbers>
#include <utility>

#include "kernel/mesh.hpp"

namespace qmorph::bands {
namespace {

/// With more for each node of the boundary there is room for other quads.
constexpr double kMostInside = 0.25;
constexpr int kMostSweeps = 20;

std::vector<Index> neighbours_of(const kernel::Mesh& mesh, Index v) {
  std::vector<Index> nodes;
  for (Index h : mesh.around(v)) nodes.push_back(mesh.target(h));
  return nodes;
}

/// Merges v into the neighbour that leaves the best triangles. False if none leaves valid ones.
bool remove(kernel::Mesh& mesh, Index v) {
  Index best = kNone;
  double most = 0;
  for (const Index to : neighbours_of(mesh, v)) {
    mesh.begin();
    const Index h = mesh.find(v, to);
    double least = 0;
    if (mesh.can_collapse(h)) {
      mesh.collapse(h);
      least = mesh.is_valid_star(to) ? mesh.smallest_sine_around(to) : 0;
    }
    mesh.rollback();
    if (least > most) most = least, best = to;
  }
  if (best == kNone) return false;
  mesh.collapse(mesh.find(v, best));
  return true;
}

/// Angle of a triangle opposite to its side h.
double opposite_angle(const kernel::Mesh& mesh, Index h) {
  const Vec2 apex = mesh.point(mesh.origin(mesh.prev(h)));
  return ccw_angle(mesh.point(mesh.origin(h)) - apex, mesh.point(mesh.target(h)) - apex);
}

/// Turns diagonals until all triangles are Delaunay, so that they lie across gaps.
void turn_diagonals(kernel::Mesh& mesh) {
  constexpr double kTolerance = 1e-9;
  bool has_turned = true;
  for (int sweep = 0; has_turned && sweep < kMostSweeps; ++sweep) {
    has_turned = false;
    for (Index h = 0; h < mesh.half_edge_slots(); h += 2) {
      if (!mesh.is_live_half_edge(h) || mesh.is_boundary_edge(h)) continue;
      const double sum = opposite_angle(mesh, h) + opposite_angle(mesh, kernel::Mesh::twin(h));
      if (sum <= std::numbers::pi + kTolerance || !mesh.can_flip(h)) continue;
      mesh.flip(h);
      has_turned = true;
    }
  }
}

/// The region's triangles without the few nodes that are inside. Nothing if these are many, or fixed, or the boundary
/// touches itself.
std::optional<kernel::Mesh> without_inner_nodes(const Region& region) {
  constexpr double kMostTriangles = 1 + 2 * kMostInside + 2.0 / 3;  // for each node of the boundary: holes have three
  if (double(region.triangles.size()) > kMostTriangles * double(region.boundary_sides)) return {};
  kernel::Mesh mesh(region.points, region.triangles, region.open);
  for (Index v : region.fixed)
    if (mesh.is_live_vertex(v) && !mesh.is_boundary(v)) return {};  // the tip of an ear is dead
  std::vector<Index> inner;
  std::size_t outer = 0;
  for (Index v = 0; v < mesh.vertex_slots(); ++v) {
    if (!mesh.is_live_vertex(v)) continue;
    if (mesh.is_boundary(v))
      ++outer;
    else
      inner.push_back(v);
  }
  if (outer != region.boundary_sides || double(inner.size()) > kMostInside * double(outer)) return {};
  for (Index v : inner)
    if (!remove(mesh, v)) return {};
  if (!inner.empty()) turn_diagonals(mesh);
  return mesh;
}

std::size_t inner_sides(const kernel::Mesh& mesh, Index f) {
  std::size_t count = 0;
  for (Index h : mesh.sides_of(f)) count += !mesh.is_boundary_edge(h);
  return count;
}

class GapFinder {
 public:
  explicit GapFinder(const kernel::Mesh& mesh)
      : mesh_(mesh), junction_(mesh.face_slots(), kNone), is_known_(mesh.half_edge_slots(), false) {
    for (Index f = 0; f < mesh.face_slots(); ++f)
      if (mesh.is_live_face(f) && inner_sides(mesh, f) == 3) junction_[f] = Index(net_.junctions++);
  }

  GapNet run() {
    for (Index f = 0; f < mesh_.face_slots(); ++f)
      if (junction_[f] != kNone)
        for (Index h : mesh_.sides_of(f))
          if (!is_known_[h]) follow(h);
    return std::move(net_);
  }

 private:
  /// `h`: a side of a junction's triangle. Looking away from it, the gap's lower side is on the right.
  void follow(Index h) {
    Gap gap;
    gap.ends[0] = {junction_[mesh_.face(h)], mesh_.origin(h), mesh_.target(h), mesh_.origin(mesh_.prev(h))};
    gap.lower = {mesh_.origin(h)}, gap.upper = {mesh_.target(h)};
    Index in = kernel::Mesh::twin(h);  // from the upper side to the lower one
    while (inner_sides(mesh_, mesh_.face(in)) == 2) {
      const Index below = mesh_.next(in), above = mesh_.prev(in);
      const bool goes_below = mesh_.is_boundary_edge(below);
      (goes_below ? gap.lower : gap.upper).push_back(mesh_.origin(above));
      in = kernel::Mesh::twin(goes_below ? above : below);
    }
    gap.ends[1] = {junction_[mesh_.face(in)], gap.lower.back(), gap.upper.back(), mesh_.origin(mesh_.prev(in))};
    is_known_[in] = true;
    net_.gaps.push_back(std::move(gap));
  }

  const kernel::Mesh& mesh_;
  std::vector<Index> junction_;  ///< by face
  std::vector<bool> is_known_;   ///< by half-edge: a gap was found from its other end
  GapNet net_;
};

}  // namespace

std::optional<GapNet> find_gaps(const Region& region) {
  const auto mesh = without_inner_nodes(region);
  if (!mesh) return {};
  GapNet net = GapFinder(*mesh).run();
  if (net.junctions == 0) return {};
  return net;
}

}  // namespace qmorph::bands
