// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/collect.hpp"

#include <utility>

namespace qmorph::chart {
namespace {

class Collector {
 public:
  explicit Collector(const Patch& patch) : patch_(patch), row_(patch.points.size(), kNone), kept_(row_.size(), false) {
    for (const auto& q : patch.quads)
      for (Index v : q) kept_[v] = true;
  }

  QuadMesh put_together(const std::vector<CurvedRegion>& regions, const std::vector<const SurfaceMesh*>& results) {
    for (std::size_t r = 0; r < regions.size(); ++r) mark_kept(regions[r], *results[r]);
    for (Index i = 0; i < patch_.points.size(); ++i)
      if (kept_[i]) row_[i] = append(patch_.points[i], i);
    for (const auto& q : patch_.quads) result_.quads.push_back({row_[q[0]], row_[q[1]], row_[q[2]], row_[q[3]]});
    for (std::size_t r = 0; r < regions.size(); ++r) add(regions[r], *results[r]);
    return std::move(result_);
  }

 private:
  void mark_kept(const CurvedRegion& region, const SurfaceMesh& mesh) {
    for (const Face& face : mesh.faces)
      for (Index i = 0; i < degree(face); ++i)
        if (face[i] < region.points.size()) kept_[region.region.node[face[i]]] = true;
  }

  Index append(const Eigen::Vector3d& p, Index source) {
    result_.points.push_back(p);
    result_.source.push_back(source);
    return Index(result_.points.size() - 1);
  }

  void add(const CurvedRegion& region, const SurfaceMesh& mesh) {
    std::vector<Index> row(mesh.points.size(), kNone);
    const auto row_of = [&](Index v) {
      if (row[v] != kNone) return row[v];
      if (v >= region.points.size()) return row[v] = append(mesh.points[v], kNone);
      row[v] = row_[region.region.node[v]];
      result_.points[row[v]] = mesh.points[v];
      return row[v];
    };
    for (const Face& face : mesh.faces) {
      std::array<Index, 4> corners{};
      for (Index i = 0; i < degree(face); ++i) corners[i] = row_of(face[i]);
      if (degree(face) == 3)
        result_.triangles.push_back({corners[0], corners[1], corners[2]});
      else
        result_.quads.push_back(corners);
    }
  }

  const Patch& patch_;
  std::vector<Index> row_;
  std::vector<bool> kept_;
  QuadMesh result_;
};

}  // namespace

QuadMesh collect(const Patch& patch, const std::vector<CurvedRegion>& regions,
                 const std::vector<const SurfaceMesh*>& meshes) {
  return Collector(patch).put_together(regions, meshes);
}

}  // namespace qmorph::chart
