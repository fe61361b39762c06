// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/views.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace qmorph::report {
namespace {

struct Column {
  const char* name;
  const std::vector<float>* values;
};

std::array<Column, 4> columns_of(const SceneFigures& figures) {
  return {{{"scaled Jacobian", &figures.scaled_jacobian},
           {"eta", &figures.eta},
           {"thesis metric", &figures.thesis_metric},
           {"size", &figures.size}}};
}

struct Datum {
  std::size_t tag;
  double value;
};

/// One section. In binary files the records are a 4-byte tag and a double each; the header is text.
std::string section(const char* kind, const char* name, const std::vector<Datum>& data, bool binary) {
  std::string text = fmt::format("${}\n1\n\"{}\"\n1\n0\n3\n0\n1\n{}\n", kind, name, data.size());
  for (const Datum& datum : data) {
    if (!binary) {
      fmt::format_to(std::back_inserter(text), "{} {}\n", datum.tag, datum.value);
      continue;
    }
    const std::int32_t tag = std::int32_t(datum.tag);
    char bytes[sizeof tag + sizeof datum.value];
    std::memcpy(bytes, &tag, sizeof tag);
    std::memcpy(bytes + sizeof tag, &datum.value, sizeof datum.value);
    text.append(bytes, sizeof bytes);
  }
  return text + (binary ? "\n" : "") + fmt::format("$End{}\n", kind);
}

}  // namespace

std::string msh_views(const Scene& scene, bool binary) {
  const SceneFigures figures = measure(scene);
  std::string text;
  for (const auto& [name, values] : columns_of(figures)) {
    std::vector<Datum> data;
    for (std::size_t f = 0; f < scene.faces.size(); ++f)
      if (!std::isnan((*values)[f])) data.push_back({scene.face_tags[f], (*values)[f]});
    text += section("ElementData", name, data, binary);
  }
  std::vector<Datum> valences;
  for (const auto& [node, valence] : figures.irregular) valences.push_back({scene.node_tags[node], double(valence)});
  return text + section("NodeData", "valence of irregular nodes", valences, binary);
}

std::string pos_views(const Scene& scene) {
  const SceneFigures figures = measure(scene);
  std::string text;
  const auto out = std::back_inserter(text);
  for (const auto& [name, values] : columns_of(figures)) {
    fmt::format_to(out, "View \"{}\" {{\n", name);
    for (std::size_t f = 0; f < scene.faces.size(); ++f) {
      const double value = (*values)[f];
      if (std::isnan(value)) continue;
      const Index corners = corners_of(scene.faces[f]);
      text += corners == 3 ? "ST(" : "SQ(";
      for (Index i = 0; i < corners; ++i) {
        const Eigen::Vector3d& p = scene.points[scene.faces[f][i]];
        fmt::format_to(out, "{}{},{},{}", i ? "," : "", p.x(), p.y(), p.z());
      }
      text += "){";
      for (Index i = 0; i < corners; ++i) fmt::format_to(out, "{}{}", i ? "," : "", value);
      text += "};\n";
    }
    text += "};\n";
  }
  return text;
}

}  // namespace qmorph::report
