// SPDX-License-Identifier: GPL-2.0-or-later
#include "bands/gap_net.hpp"

#include <algorithm>
#include <utility>

#include "kernel/mesh.hpp"

namespace qmorph::bands {
namespace {

bool has_only_boundary_nodes(const Region& region, const kernel::Mesh& mesh) {
  std::size_t nodes = 0;
  for (Index v = 0; v < mesh.vertex_slots(); ++v) {
    if (!mesh.is_live_vertex(v)) continue;
    if (!mesh.is_boundary(v)) return false;
    ++nodes;
  }
  return nodes == region.boundary_sides;
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
      if (inner_sides(mesh, f) == 3) junction_[f] = Index(net_.junctions++);
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
  const kernel::Mesh mesh(region.points, region.triangles, region.open);
  if (!has_only_boundary_nodes(region, mesh)) return {};
  GapNet net = GapFinder(mesh).run();
  if (net.junctions == 0) return {};
  return net;
}

}  // namespace qmorph::bands
