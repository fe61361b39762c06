// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/collector.hpp"

#include <algorithm>

namespace qmorph {

Collector::Collector(const Patch& patch, const Plane& plane, const std::vector<Vec2>& plane_points)
    : patch_(patch),
      plane_(plane),
      plane_points_(plane_points),
      row_(patch.points.size(), kNone),
      used_(patch.points.size(), false) {
  for (const auto& q : patch.quads)
    for (Index v : q) used_[v] = true;
}

void Collector::add(const Region& region, const kernel::Mesh& mesh) {
  const Index count = std::min(Index(region.node.size()), mesh.vertex_slots());  // nothing of a region that is left out
  for (Index v = 0; v < count; ++v)
    if (mesh.is_live_vertex(v)) used_[region.node[v]] = true;
  parts_.emplace_back(&region, &mesh);
}

QuadMesh Collector::finish() {
  for (Index i = 0; i < patch_.points.size(); ++i)
    if (used_[i]) row_[i] = append(patch_.points[i], i);
  for (const auto& q : patch_.quads) result_.quads.push_back({row_[q[0]], row_[q[1]], row_[q[2]], row_[q[3]]});
  for (const auto& [region, mesh] : parts_) add_elements(*region, *mesh);
  return std::move(result_);
}

Index Collector::append(const Eigen::Vector3d& p, Index source) {
  result_.points.push_back(p);
  result_.source.push_back(source);
  return Index(result_.points.size() - 1);
}

void Collector::add_elements(const Region& region, const kernel::Mesh& mesh) {
  std::vector<Index> row(mesh.vertex_slots(), kNone);
  for (Index v = 0; v < mesh.vertex_slots(); ++v) {
    if (!mesh.is_live_vertex(v)) continue;
    if (v < region.node.size()) {
      const Index node = region.node[v];
      row[v] = row_[node];
      if (mesh.point(v) != plane_points_[node]) result_.points[row[v]] = plane_.to_space(mesh.point(v));
    } else {
      row[v] = append(plane_.to_space(mesh.point(v)), kNone);
    }
  }
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    const Index h = mesh.half_edge(f);
    const Index a = mesh.origin(h), b = mesh.target(h), c = mesh.target(mesh.next(h));
    if (mesh.degree(f) == 3)
      result_.triangles.push_back({row[a], row[b], row[c]});
    else
      result_.quads.push_back({row[a], row[b], row[c], row[mesh.origin(mesh.prev(h))]});
  }
}

}  // namespace qmorph
