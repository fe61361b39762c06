// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/views/views.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <numeric>
#include <optional>
#include <utility>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

/// \return nothing if the step is empty, or not on nodes and elements
std::optional<ViewStep> read_step(int view, const std::string& name, int number) {
  ViewStep step;
  step.name = name;
  step.step = number;
  const StageLog log = run_logged(
      [&] { ::gmsh::view::getModelData(view, number, step.kind, step.tags, step.values, step.time, step.components); });
  if (!log.errors.empty() || step.tags.empty() || step.components < 1) return std::nullopt;
  step.sort();  // Gmsh's order is another sometimes
  return step;
}

void append_step(fmt::memory_buffer& out, bool binary, const ViewStep& step) {
  const auto raw = [&](const auto& value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    out.append(bytes, bytes + sizeof value);
  };
  const bool at_nodes = step.kind == "ElementNodeData";
  const auto line = std::back_inserter(out);
  fmt::format_to(line, "${}\n1\n\"{}\"\n1\n{}\n3\n{}\n{}\n{}\n", step.kind, step.name, step.time, step.step,
                 step.components, step.tags.size());
  for (std::size_t i = 0; i < step.tags.size(); ++i) {
    const auto count = static_cast<std::int32_t>(step.values[i].size() / static_cast<std::size_t>(step.components));
    if (binary) {
      raw(static_cast<std::int32_t>(step.tags[i]));
      if (at_nodes) raw(count);
      for (double value : step.values[i]) raw(value);
    } else {
      fmt::format_to(line, "{} {}{}\n", step.tags[i], at_nodes ? fmt::format("{} ", count) : "",
                     fmt::join(step.values[i], " "));
    }
  }
  fmt::format_to(line, "{}$End{}\n", binary ? "\n" : "", step.kind);
}

}  // namespace

void ViewStep::sort() {
  std::vector<std::size_t> order(tags.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return tags[a] < tags[b]; });
  ViewStep sorted = *this;
  for (std::size_t i = 0; i < order.size(); ++i) {
    sorted.tags[i] = tags[order[i]];
    sorted.values[i] = std::move(values[order[i]]);
  }
  *this = std::move(sorted);
}

const std::vector<double>* ViewStep::find(std::size_t tag) const {
  const auto found = std::lower_bound(tags.begin(), tags.end(), tag);
  if (found == tags.end() || *found != tag) return nullptr;
  return &values[static_cast<std::size_t>(found - tags.begin())];
}

MeshData read_steps(const std::vector<int>& but_views) {
  MeshData data;
  std::vector<int> views;
  ::gmsh::view::getTags(views);
  for (int view : views) {
    if (std::count(but_views.begin(), but_views.end(), view)) continue;
    const std::string option = fmt::format("View[{}].", ::gmsh::view::getIndex(view));
    std::string name;
    ::gmsh::option::getString(option + "Name", name);
    const std::size_t before = data.steps.size();
    const int steps = static_cast<int>(get_option(option + "NbTimeStep"));
    for (int number = 0; number < steps; ++number)
      if (auto step = read_step(view, name, number)) data.steps.push_back(std::move(*step));
    if (data.steps.size() == before)
      data.warnings.push_back(fmt::format("the view \"{}\" is not on nodes or elements, and is not written", name));
  }
  return data;
}

MeshData read_views(const std::vector<ViewStep>& more) {
  MeshData data = read_steps();
  for (const ViewStep& step : more) {
    const auto same = std::find_if(data.steps.begin(), data.steps.end(), [&](const ViewStep& other) {
      return other.name == step.name && other.kind == step.kind && other.step == step.step &&
             other.components == step.components;
    });
    if (same == data.steps.end()) {
      data.steps.push_back(step);
      continue;
    }
    same->tags.insert(same->tags.end(), step.tags.begin(), step.tags.end());
    same->values.insert(same->values.end(), step.values.begin(), step.values.end());
    same->sort();
  }
  if (!data.steps.empty()) data.mesh = read_model_mesh();
  return data;
}

void append_views(const std::string& path, bool binary, const std::vector<ViewStep>& steps) {
  std::ofstream out(path, std::ios::binary | std::ios::app);
  for (const ViewStep& step : steps) {
    fmt::memory_buffer text;
    append_step(text, binary, step);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
  }
  out.close();
  if (!out) throw OutputError(fmt::format("cannot write {}: {}", path, std::strerror(errno)));
}

}  // namespace qmorph::adapter
