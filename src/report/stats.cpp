// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/stats.hpp"

#include <map>
#include <nlohmann/json.hpp>

#include "quality/percentile.hpp"
#include "report/version.hpp"

namespace qmorph::report {
namespace {

using Json = nlohmann::ordered_json;

Json histogram(const std::map<int, std::size_t>& counts) {
  Json json = Json::object();
  for (const auto& [valence, count] : counts) json[std::to_string(valence)] = count;
  return json;
}

Json quality_json(const Quality& q) {
  Json json;
  json["quads"] = q.quads;
  json["triangles"] = q.triangles;
  json["inverted"] = q.inverted;
  if (q.quads) {
    json["scaled_jacobian"] = {{"min", q.scaled_jacobian_min},
                               {"p1", q.scaled_jacobian_p1},
                               {"p5", q.scaled_jacobian_p5},
                               {"mean", q.scaled_jacobian_mean},
                               {"share_below_0.3", q.scaled_jacobian_below_03}};
    json["eta"] = {{"min", q.eta_min}, {"mean", q.eta_mean}};
    json["thesis_metric"] = {{"min", q.thesis_min}, {"mean", q.thesis_mean}};
    json["angle_deg"] = {{"min", q.angle_min_deg}, {"max", q.angle_max_deg}};
  }
  json["interior_nodes"] = q.interior_nodes;
  json["irregular_nodes"] = q.irregular_nodes;
  json["irregular_share"] = q.irregular_share();
  json["valence_interior"] = histogram(q.valence);
  json["valence_boundary"] = histogram(q.boundary_valence);
  return json;
}

Json spread_json(const Spread& s) {
  return {{"mean", s.mean}, {"p99", s.p99}, {"max", s.max}, {"where", {s.where.x(), s.where.y(), s.where.z()}}};
}

/// Of curved surfaces. Distances are in edges.
Json fidelity_json(const Fidelity& f) {
  return {
      {"quads", f.quads},
      {"distance", {{"node", spread_json(f.node)}, {"side", spread_json(f.side)}, {"centre", spread_json(f.centre)}}},
      {"distance_back", spread_json(f.back)},
      {"normal_deg", spread_json(f.normal_deg)},
      {"warpage_deg", spread_json(f.warpage_deg)}};
}

Json on_geometry_json(const OnGeometry& nodes) {
  return {{"nodes", nodes.nodes}, {"left", nodes.left}, {"moved_sides", nodes.moved_sides}};
}

/// How many quads under 0.3 there are for each reason.
Json poor_json(const std::array<std::size_t, kPoorReasons>& counts) {
  Json json = Json::object();
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i]) json[std::string(name_of(PoorBecause(i)))] = counts[i];
  return json;
}

Json poor_json(const std::vector<PoorQuad>& poor) {
  Json json = Json::array();
  for (const PoorQuad& quad : poor)
    json.push_back({{"because", name_of(quad.reason)},
                    {"scaled_jacobian", quad.scaled_jacobian},
                    {"where", {quad.where.x(), quad.where.y(), quad.where.z()}}});
  return json;
}

/// A row of the table of stages. Shape figures are those of the quads; `triangle_metric` is that of the triangles.
Json stage_json(const StageFigures& stage) {
  const Quality q = stage.quality.result();
  Json json = {{"stage", name_of(stage.stage)}, {"seconds", stage.seconds}, {"quads", q.quads},
               {"triangles", q.triangles},      {"inverted", q.inverted},   {"irregular_share", q.irregular_share()}};
  if (q.quads) {
    json["scaled_jacobian"] = {
        {"min", q.scaled_jacobian_min}, {"p1", q.scaled_jacobian_p1}, {"mean", q.scaled_jacobian_mean}};
    json["thesis_metric"] = {{"min", q.thesis_min}, {"mean", q.thesis_mean}};
  }
  if (q.triangles) json["triangle_metric"] = {{"min", q.triangle_metric_min}, {"mean", q.triangle_metric_mean}};
  return json;
}

Json stages_json(const std::vector<StageFigures>& stages) {
  Json rows = Json::array();
  for (const StageFigures& stage : stages) rows.push_back(stage_json(stage));
  return rows;
}

/// Edge length of the result over the input's nearby.
Json size_json(std::vector<double> ratios) {
  if (ratios.empty()) return Json::object();
  return {{"median", percentile(ratios, 50)}, {"p5", percentile(ratios, 5)}, {"p95", percentile(ratios, 95)}};
}

/// Lengths over those of the triangles, in the direction in which these are longest and in the other.
Json directions_json(const std::vector<DirectedSize>& sizes) {
  std::vector<double> along, across;
  for (const DirectedSize& size : sizes) along.push_back(size.along), across.push_back(size.across);
  return {{"along", size_json(along)}, {"across", size_json(across)}};
}

Json engine_json(const ConversionReport& s, const History& history) {
  return {{"regions", s.regions},
          {"odd_regions", s.odd_regions},
          {"layer_quads", s.layer_quads},
          {"front_quads", s.front_quads},
          {"leftover_triangles", s.leftover_triangles},
          {"seconds",
           {{"front", s.front_seconds},
            {"elimination", s.elimination_seconds},
            {"cleanup", s.cleanup_seconds},
            {"smoothing", s.smoothing_seconds}}},
          {"size_ratio", size_json(history.size_ratios)},
          {"directed_size_ratio", directions_json(s.sizes)},
          {"stages", stages_json(history.stages)}};
}

Json even_json(const EvenReport& even) {
  Json json = {{"odd_regions", even.odd_regions}, {"splits", Json::array()}, {"odd_surfaces", even.odd_surfaces}};
  for (const SplitEdge& split : even.splits)
    json["splits"].push_back({{"curve", split.curve},
                              {"surfaces", split.surfaces},
                              {"where", {split.where.x(), split.where.y(), split.where.z()}}});
  return json;
}

/// Of the surfaces that were converted.
History sum_of(const ModelReport& model, const Recorder& recorder) {
  History sum;
  for (const SurfaceReport& surface : model.surfaces)
    if (const History* history = recorder.find(surface)) sum.add_figures(*history);
  return sum;
}

const char* outcome_name(SurfaceOutcome outcome) {
  switch (outcome) {
    case SurfaceOutcome::converted:
      return "converted";
    case SurfaceOutcome::already_quads:
      return "already quads";
    case SurfaceOutcome::left:
      return "left as it was";
  }
  return "";
}

Json surface_json(const SurfaceReport& s, const Recorder& recorder) {
  Json json;
  json["tag"] = s.tag;
  json["name"] = s.name;
  json["outcome"] = outcome_name(s.outcome);
  if (!s.reason.empty()) json["reason"] = s.reason;
  json["warnings"] = s.warnings;
  json["before"] = {{"triangles", s.triangles_in}, {"quads", s.quads_in}};
  json["after"] = {{"triangles", s.triangles_out}, {"quads", s.quads_out}};
  if (s.outcome != SurfaceOutcome::left) json["quality"] = quality_json(s.quality);
  if (s.outcome == SurfaceOutcome::converted) {
    if (s.fidelity.quads) json["in_space"] = fidelity_json(s.fidelity);
    if (s.on_geometry.any()) json["on_geometry"] = on_geometry_json(s.on_geometry);
    if (!s.poor.empty()) json["poor_quads"] = poor_json(s.poor);
    const History* history = recorder.find(s);
    json["engine"] = engine_json(s.conversion, history ? *history : History());
  }
  json["seconds"] = s.seconds;
  return json;
}

}  // namespace

std::string stats_json(const ModelReport& model, const Recorder& recorder, const RunFacts& facts) {
  Json json;
  json["program"] = "qmorph";
  json["version"] = kVersion;
  json["input"] = facts.input;
  json["output"] = facts.output;
  json["arguments"] = facts.arguments;
  json["exit_status"] = facts.exit_status;
  json["seconds"] = {{"open", facts.open_seconds},   {"mesh", facts.mesh_seconds},
                     {"read", model.read_seconds},   {"convert", model.convert_seconds},
                     {"check", model.check_seconds}, {"replace", model.replace_seconds},
                     {"write", facts.write_seconds}, {"total", facts.total_seconds}};
  json["warnings"] = model.warnings;
  json["total"] = quality_json(model.total);
  if (model.fidelity.quads) json["in_space"] = fidelity_json(model.fidelity);
  if (model.on_geometry.any()) json["on_geometry"] = on_geometry_json(model.on_geometry);
  json["poor_quads"] = poor_json(model.count_poor());
  const History sum = sum_of(model, recorder);
  ConversionReport conversions;
  for (const SurfaceReport& surface : model.surfaces) conversions.add(surface.conversion);
  json["layer_quads"] = conversions.layer_quads;
  json["size_ratio"] = size_json(sum.size_ratios);
  json["directed_size_ratio"] = directions_json(conversions.sizes);
  json["stages"] = stages_json(sum.stages);
  if (facts.even) json["all_quad"] = even_json(*facts.even);
  if (facts.division.understood)
    json["curves"] = {{"more_segments", facts.division.more},
                      {"fewer_segments", facts.division.fewer},
                      {"around_coarse_surfaces", facts.division.coarse_surfaces},
                      {"splits", even_json(facts.mended)["splits"]}};
  if (facts.volumes.volumes)
    json["volumes"] = {{"volumes", facts.volumes.volumes},
                       {"hexahedra", facts.volumes.hexahedra},
                       {"prisms", facts.volumes.prisms},
                       {"pyramids", facts.volumes.pyramids},
                       {"tetrahedra", facts.volumes.tetrahedra}};
  json["surfaces"] = Json::array();
  for (const SurfaceReport& surface : model.surfaces) json["surfaces"].push_back(surface_json(surface, recorder));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace qmorph::report
