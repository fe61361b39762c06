// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/convert_curved.hpp"

#include <numeric>

#include "chart/curved_region.hpp"
#include "parallel/for_each.hpp"
#include "parallel/shared_progress.hpp"

namespace qmorph::chart {
namespace {

/// Puts regions together: kept nodes of the patch in their order, then new ones.
class Collector {
 public:
  explicit Collector(const Patch& patch) : patch_(patch), row_(patch.points.size(), kNone), kept_(row_.size(), false) {
    for (const auto& q : patch.quads)
      for (Index v : q) kept_[v] = true;
  }

  QuadMesh put_together(const std::vector<CurvedRegion>& regions, const std::vector<SurfaceMesh>& results) {
    for (std::size_t r = 0; r < regions.size(); ++r) mark_kept(regions[r], results[r]);
    for (Index i = 0; i < patch_.points.size(); ++i)
      if (kept_[i]) row_[i] = append(patch_.points[i], i);
    for (const auto& q : patch_.quads) result_.quads.push_back({row_[q[0]], row_[q[1]], row_[q[2]], row_[q[3]]});
    for (std::size_t r = 0; r < regions.size(); ++r) add(regions[r], results[r]);
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

SurfaceWork convert_curved(const Patch& patch, const Options& options) {
  const std::vector<CurvedRegion> regions = curved_regions(patch, options.crease_angle);
  std::vector<SurfaceMesh> results(regions.size());
  std::vector<ConversionReport> reports(regions.size());
  const parallel::SharedProgress shared(options.progress, double(patch.triangles.size()));
  std::vector<ProgressCallback> progress;
  for (const CurvedRegion& region : regions) progress.push_back(shared.part(double(region.region.triangles.size())));
  parallel::for_each_index(regions.size(), [&](std::size_t r) {
    if (shared.is_over()) return;
    Options own = options;
    own.progress = progress[r];
    results[r] = convert_region(regions[r], own, reports[r]);
  });
  shared.finish();
  SurfaceWork work;
  work.conversion.mesh = Collector(patch).put_together(regions, results);
  ConversionReport& report = work.conversion.report;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    report.add(reports[r]);
    ++report.regions;
    report.odd_regions += regions[r].region.boundary_sides % 2;
  }
  return work;
}

}  // namespace qmorph::chart
