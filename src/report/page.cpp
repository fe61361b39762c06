// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/page.hpp"

#include <algorithm>
#include <cmath>

#include "report/drawing.hpp"
#include "report/page_parts.hpp"
#include "report/page_sources.hpp"
#include "report/version.hpp"

namespace qmorph::report {
namespace {

using Json = nlohmann::ordered_json;

/// Figures between -4 and 1 are written as 16-bit numbers: this many to 1.
constexpr double kFigureSteps = 8000;
constexpr std::int16_t kNoFigure = -32768;

std::vector<std::int16_t> quantised(const std::vector<float>& figures) {
  std::vector<std::int16_t> values(figures.size());
  for (std::size_t i = 0; i < figures.size(); ++i)
    values[i] = std::isnan(figures[i])
                    ? kNoFigure
                    : std::int16_t(std::lround(std::clamp(double(figures[i]), -4.0, 4.0) * kFigureSteps));
  return values;
}

/// `rows` of two or four, as one list; kNone is left out.
template <std::size_t N>
std::vector<std::uint32_t> flattened(const std::vector<std::array<Index, N>>& rows) {
  std::vector<std::uint32_t> list;
  list.reserve(N * rows.size());
  for (const auto& row : rows)
    for (Index node : row)
      if (node != kNone) list.push_back(node);
  return list;
}

std::vector<float> coordinates(const Scene& scene, const Frame& frame) {
  std::vector<float> list;
  list.reserve((frame.flat ? 2 : 3) * scene.points.size());
  for (const auto& p : scene.points) {
    const Eigen::Vector3d local = frame.to_frame(p);
    for (int i = 0; i < (frame.flat ? 2 : 3); ++i) list.push_back(float(local[i]));
  }
  return list;
}

Json entities_json(const std::vector<SceneEntity>& entities) {
  Json list = Json::array();
  for (const SceneEntity& entity : entities)
    list.push_back({{"tag", entity.tag}, {"groups", entity.groups}, {"first", entity.first}, {"count", entity.count}});
  return list;
}

Json scene_json(const Scene& scene, const Frame& frame, Blob& blob) {
  const SceneFigures figures = measure(scene);
  std::vector<std::uint8_t> corners(scene.faces.size());
  for (std::size_t f = 0; f < scene.faces.size(); ++f) corners[f] = std::uint8_t(corners_of(scene.faces[f]));
  std::vector<std::uint32_t> irregular;
  std::vector<std::uint8_t> valences;
  for (const auto& [node, valence] : figures.irregular) {
    irregular.push_back(node);
    valences.push_back(std::uint8_t(std::min(valence, 255)));
  }
  Json json;
  json["points"] = blob.add(std::span<const float>(coordinates(scene, frame)));
  json["node_tags"] = blob.add_tags(scene.node_tags);
  json["corner_counts"] = blob.add(std::span<const std::uint8_t>(corners));
  json["corners"] = blob.add(std::span<const std::uint32_t>(flattened(scene.faces)));
  json["face_tags"] = blob.add_tags(scene.face_tags);
  json["figures"]["scaled_jacobian"] = blob.add(std::span<const std::int16_t>(quantised(figures.scaled_jacobian)));
  json["figures"]["eta"] = blob.add(std::span<const std::int16_t>(quantised(figures.eta)));
  json["figures"]["thesis_metric"] = blob.add(std::span<const std::int16_t>(quantised(figures.thesis_metric)));
  json["figures"]["size"] = blob.add(std::span<const float>(figures.size));
  json["lines"] = blob.add(std::span<const std::uint32_t>(flattened(scene.lines)));
  json["open_edges"] = blob.add(std::span<const std::uint32_t>(flattened(figures.open_edges)));
  json["dots"] = blob.add(std::span<const std::uint32_t>(scene.dots));
  json["irregular"] = blob.add(std::span<const std::uint32_t>(irregular));
  json["valences"] = blob.add(std::span<const std::uint8_t>(valences));
  json["surfaces"] = entities_json(scene.surfaces);
  json["curves"] = entities_json(scene.curves);
  json["groups"] = Json::array();
  for (const SceneGroup& group : scene.groups)
    json["groups"].push_back({{"dim", group.dim}, {"tag", group.tag}, {"name", group.name}});
  return json;
}

Json vector_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// The colours of the scale, so that pages and pictures have the same.
Json scale_json() {
  constexpr int kColours = 256;
  Json list = Json::array();
  for (int i = 0; i < kColours; ++i) {
    const Colour c = on_scale(double(i) / (kColours - 1));
    list.push_back({c.red, c.green, c.blue});
  }
  return list;
}

Json frame_json(const Frame& frame, const Viewpoint& from) {
  const Turn turn = frame.flat ? Turn{} : turn_of(frame, from);
  return {{"centre", vector_json(frame.centre)},
          {"right", vector_json(frame.right)},
          {"up", vector_json(frame.up)},
          {"radius", frame.radius},
          {"flat", frame.flat},
          {"turned", {turn.up, turn.right}}};
}

}  // namespace

std::string report_page(const Scene& before, const Scene& after, const ModelReport& model, const Recorder& recorder,
                        const RunFacts& facts, const Viewpoint& from) {
  const Frame frame = find_frame(after);
  Blob blob;
  Json json;
  json["kind"] = "report";
  json["version"] = kVersion;
  json["command"] = command_line(facts.arguments);
  json["frame"] = frame_json(frame, from);
  json["scale"] = scale_json();
  json["figure_steps"] = kFigureSteps;
  json["meshes"]["before"] = scene_json(before, frame, blob);
  json["meshes"]["after"] = scene_json(after, frame, blob);
  json["stats"] = Json::parse(stats_json(model, recorder, facts));
  return fill_page(kReportPage, file_name(facts.output) + " – qmorph", json, blob);
}

}  // namespace qmorph::report
