// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/convert/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "gmsh/convert/complaints.hpp"
#include "gmsh/convert/whole_surface.hpp"
#include "qmorph/check.hpp"
#include "quality/directed_size.hpp"

namespace qmorph::adapter {
namespace {

/// Means of scaled Jacobians that differ by no more than this count as equal.
constexpr double kSameMean = 1e-9;

}  // namespace

void Figures::add_result(ConvertedSurface& converted, SurfaceReport& report) {
  QualityAccumulator quality;
  FidelityAccumulator fidelity;
  report.triangles_out = report.quads_out = 0;
  for (Judged& judged : converted.judged) {
    const QuadMesh& result = judged.after();
    judged.add_to(quality);
    judged.add_to(fidelity);
    const auto figures = quality.scaled_jacobians().subspan(report.quads_out);
    for (PoorQuad poor : explain_poor_quads(judged, figures, crease_angle_)) {
      poor.quad += Index(report.quads_out);
      report.poor.push_back(poor);
    }
    report.triangles_out += result.triangles.size();
    report.quads_out += result.quads.size();
  }
  total_.add(quality);
  fidelity_.add(fidelity);
  report.fidelity = fidelity.result();
  report.quality = quality.result();
  report.conversion = converted.report;
  report.on_geometry = converted.on_geometry;
  on_geometry_.add(converted.on_geometry);
  report.warnings = converted.surface.warnings;
  if (std::string lost = describe_lost_size(report.conversion.sizes); !lost.empty())
    report.warnings.push_back(std::move(lost));
}

void Figures::compare_with_input(const ConvertedSurface& converted, SurfaceReport& report) {
  QualityAccumulator before;
  for (const SurfacePart& part : converted.surface.parts)
    before.add(part.patch.points, part.patch.triangles, part.patch.quads, mean_normal(part.patch));
  total_before_.add(before);
  const Quality was = before.result();
  if (report.conversion.worse_regions > 0)
    report.warnings.push_back(
        fmt::format("{} triangles could not go without quads getting worse: scaled Jacobian min {:.3f} -> {:.3f}, mean "
                    "{:.3f} -> {:.3f}",
                    report.triangles_in, was.scaled_jacobian_min, report.quality.scaled_jacobian_min,
                    was.scaled_jacobian_mean, report.quality.scaled_jacobian_mean));
}

void Figures::add_as_it_is(const SurfaceMesh& surface, const Patch* before, SurfaceReport& report) {
  QualityAccumulator quality;
  for (const SurfacePart& part : surface.parts) quality.add(part.patch.points, part.patch.triangles, part.patch.quads);
  total_.add(quality);
  report.quality = quality.result();
  if (!before) return;
  FidelityAccumulator fidelity;
  const Patch now = whole_surface(surface);
  report.conversion.sizes = directed_sizes(*before, now.points, now.quads);
  fidelity.add_any(*before, as_result(now));
  fidelity_.add(fidelity);
  report.fidelity = fidelity.result();
}

void Figures::put_into(ModelReport& report) const {
  report.total = total_.result();
  report.fidelity = fidelity_.result();
  report.on_geometry = on_geometry_;
  const Quality before = total_before_.result();
  const bool said = std::any_of(report.surfaces.begin(), report.surfaces.end(),
                                [](const SurfaceReport& surface) { return surface.conversion.worse_regions > 0; });
  if (before.quads > 0 && !said && report.total.scaled_jacobian_mean < before.scaled_jacobian_mean - kSameMean)
    report.warnings.push_back(
        fmt::format("the mean scaled Jacobian of all quads fell from {:.4f} to {:.4f}, since triangles became quads",
                    before.scaled_jacobian_mean, report.total.scaled_jacobian_mean));
}

}  // namespace qmorph::adapter
