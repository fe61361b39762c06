// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <string>
#include <vector>

#include "quality/directed_size.hpp"

namespace qmorph::report {
namespace {

std::string counted(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string elements(std::size_t triangles, std::size_t quads) {
  if (triangles == 0) return counted(quads, "quad");
  if (quads == 0) return counted(triangles, "triangle");
  return counted(quads, "quad") + " and " + counted(triangles, "triangle");
}

/// `quads`: how many there are. Those of surfaces that were left as they were are not measured.
std::string figures(const Quality& quality, std::size_t quads) {
  if (quality.quads == 0) return quads ? "not measured" : "no quad";
  return fmt::format("scaled Jacobian min {:.3f} mean {:.3f}; irregular {:.1f} %", quality.scaled_jacobian_min,
                     quality.scaled_jacobian_mean, 100 * quality.irregular_share());
}

/// "; 3 quads under 0.3, 2 of them forced by the input"
std::string poor(const ModelReport& model) {
  const auto counts = model.count_poor();
  std::size_t all = 0;
  for (std::size_t count : counts) all += count;
  if (all == 0) return "";
  const std::size_t ours = counts[std::size_t(PoorBecause::nothing)];
  const std::string forced = ours == 0 ? "all" : std::to_string(all - ours) + " of them";
  return fmt::format("; {} under {:g}, {} forced by the input", counted(all, "quad"), kPoorQuad, forced);
}

/// "; centres 0.012 edges off the surface (at most 0.11)"
std::string distance(const Fidelity& fidelity) {
  if (fidelity.quads == 0) return "";
  return fmt::format("; centres {:.3f} edges off the surface (at most {:.2f})", fidelity.centre.mean,
                     fidelity.centre.max);
}

/// "; nodes on the geometry but 3 of 90; 1 side moved to unfold elements", as far as there is something to say.
std::string on_geometry(const OnGeometry& nodes) {
  std::string said;
  if (nodes.all() > 0) said = "; nodes on the geometry";
  if (nodes.left > 0) said += fmt::format(" but {} of {}", nodes.left, nodes.all());
  if (nodes.moved_sides > 0) said += fmt::format("; {} moved to unfold elements", counted(nodes.moved_sides, "side"));
  return said;
}

std::string sizes(const std::vector<DirectedSize>& all) {
  if (all.empty()) return "";
  const DirectedSize size = median(all);
  return fmt::format("; size {:.2f} along {:.2f} across", size.along, size.across);
}

}  // namespace

std::string surface_line(const SurfaceReport& surface) {
  std::string line = fmt::format("surface {}", surface.tag);
  if (!surface.name.empty()) line += fmt::format(" \"{}\"", surface.name);
  const std::string before = elements(surface.triangles_in, surface.quads_in);
  switch (surface.outcome) {
    case SurfaceOutcome::left:
      return line + fmt::format(": {} left as {}: {}", before,
                                surface.triangles_in + surface.quads_in == 1 ? "it was" : "they were", surface.reason);
    case SurfaceOutcome::already_quads:
      return line + fmt::format(": {} already; {}", before, figures(surface.quality, surface.quads_out));
    case SurfaceOutcome::converted:
      break;
  }
  std::string after = elements(surface.triangles_out, surface.quads_out);
  if (surface.conversion.layer_quads > 0)
    after += fmt::format(", {} of them in layers", surface.conversion.layer_quads);
  return line + fmt::format(": {} -> {}; {}{}", before, after, figures(surface.quality, surface.quads_out),
                            sizes(surface.conversion.sizes));
}

std::string check_line(const ModelReport& model) {
  std::size_t triangles = 0, quads = 0;
  for (const SurfaceReport& surface : model.surfaces) {
    triangles += surface.triangles_in;
    quads += surface.quads_in;
  }
  ConversionReport sum;
  for (const SurfaceReport& surface : model.surfaces) sum.add(surface.conversion);
  return fmt::format("{} on {}; {}{}{}", elements(triangles, quads), counted(model.surfaces.size(), "surface"),
                     figures(model.total, quads), sizes(sum.sizes), distance(model.fidelity));
}

std::string total_line(const ModelReport& model, const std::string& output, double seconds) {
  std::size_t triangles_in = 0, quads_in = 0, triangles_out = 0, quads_out = 0;
  for (const SurfaceReport& surface : model.surfaces) {
    triangles_in += surface.triangles_in;
    quads_in += surface.quads_in;
    triangles_out += surface.triangles_out;
    quads_out += surface.quads_out;
  }
  return fmt::format("total: {} -> {}; {}{}{}{}; {:.2f} s; {}", elements(triangles_in, quads_in),
                     elements(triangles_out, quads_out), figures(model.total, quads_out), distance(model.fidelity),
                     on_geometry(model.on_geometry), poor(model), seconds, output);
}

std::string volume_line(const adapter::VolumeCounts& volumes) {
  std::vector<std::string> kinds;
  const auto add = [&](std::size_t count, const char* one, const char* several) {
    if (count) kinds.push_back(fmt::format("{} {}", count, count == 1 ? one : several));
  };
  add(volumes.hexahedra, "hexahedron", "hexahedra");
  add(volumes.prisms, "prism", "prisms");
  add(volumes.pyramids, "pyramid", "pyramids");
  add(volumes.tetrahedra, "tetrahedron", "tetrahedra");
  return fmt::format("{}: {}", counted(volumes.volumes, "volume"), fmt::join(kinds, ", "));
}

std::string even_line(const EvenReport& even) {
  std::map<int, std::size_t> count;
  for (const SplitEdge& split : even.splits) ++count[split.curve];
  std::vector<std::string> curves;
  for (const auto& [curve, splits] : count)
    if (curve) curves.push_back(std::to_string(curve) + (splits > 1 ? fmt::format(" ({})", splits) : ""));
  std::string where = "no curve";  // where surfaces meet without one
  if (!curves.empty()) where = fmt::format("curve{} {}", curves.size() == 1 ? "" : "s", fmt::join(curves, ", "));
  if (!curves.empty() && count.contains(0)) where += fmt::format(" and on none ({})", count.at(0));
  const std::size_t splits = even.splits.size();
  std::string line =
      splits == 0 ? "--all-quad: no segment had to be split"
                  : fmt::format("--all-quad: {} segment{} got a node, on {} ({} region{} had an odd boundary)", splits,
                                splits == 1 ? "" : "s", where, even.odd_regions, even.odd_regions == 1 ? "" : "s");
  if (!even.odd_surfaces.empty())
    line += fmt::format("; no way to make surface{} {} even", even.odd_surfaces.size() == 1 ? "" : "s",
                        fmt::join(even.odd_surfaces, ", "));
  return line;
}

std::string named_surfaces(const std::vector<int>& tags) {
  constexpr std::size_t kMostNamed = 12;
  return tags.size() > kMostNamed ? counted(tags.size(), "surface")
                                  : fmt::format("surface{} {}", tags.size() == 1 ? "" : "s", fmt::join(tags, ", "));
}

std::string division_line(const adapter::DivisionReport& division, const EvenReport& mended) {
  const auto name = [](const std::vector<int>& curves, const char* how) {
    constexpr std::size_t kMostNamed = 12;
    return curves.empty()                ? std::string()
           : curves.size() <= kMostNamed ? fmt::format("{} ({}) {}", curves.size(), fmt::join(curves, ", "), how)
                                         : fmt::format("{} {}", curves.size(), how);
  };
  std::vector<std::string> parts;
  for (const std::string& part : {name(division.more, "have more"), name(division.fewer, "have fewer")})
    if (!part.empty()) parts.push_back(part);
  if (!mended.splits.empty()) parts.push_back(counted(mended.splits.size(), "segment") + " got a node afterwards");
  if (parts.empty()) return {};
  std::string line =
      fmt::format("curves with other numbers of segments than Gmsh's, for even boundaries and rows that fit: {}",
                  fmt::join(parts, ", "));
  if (const auto& coarse = division.coarse_surfaces; !coarse.empty())
    line += fmt::format("; some around {}, too sharply curved for the sizes there", named_surfaces(coarse));
  return line;
}

}  // namespace qmorph::report
