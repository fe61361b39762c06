// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/divide/coarse.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/element_types.hpp"
#include "gmsh/session/session.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector3d;

struct Facet {
  std::array<std::size_t, 3> nodes;
  double area;
  Vector3d normal;
};

std::vector<Facet> facets_of(int surface) {
  std::vector<std::size_t> tags, nodes;
  ::gmsh::model::mesh::getElementsByType(kTriangle3, tags, nodes, surface);
  std::unordered_map<std::size_t, Vector3d> points;
  const auto point = [&](std::size_t node) {
    const auto [at, is_new] = points.try_emplace(node);
    if (is_new) at->second = Vector3d::Map(placed_node(node).xyz.data());
    return at->second;
  };
  std::vector<Facet> facets;
  for (std::size_t i = 0; i + 2 < nodes.size(); i += 3) {
    const Vector3d a = point(nodes[i]), b = point(nodes[i + 1]), c = point(nodes[i + 2]);
    const Vector3d twice = (b - a).cross(c - a);
    facets.push_back({{nodes[i], nodes[i + 1], nodes[i + 2]}, 0.5 * twice.norm(), twice.normalized()});
  }
  return facets;
}

double area_of(const std::vector<Facet>& facets) {
  double area = 0;
  for (const Facet& facet : facets) area += facet.area;
  return area;
}

/// Of the area, that of facets which stand at far more than a right angle to one beside them.
double bent_share(const std::vector<Facet>& facets) {
  constexpr double kFarMore = -0.2;  // cosine: four edges around a tube are right angles
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> first;
  std::vector<char> is_bent(facets.size(), 0);
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(facets[f].nodes[i], facets[f].nodes[(i + 1) % 3]);
      const auto [side, is_new] = first.try_emplace({a, b}, f);
      if (!is_new && facets[f].normal.dot(facets[side->second].normal) < kFarMore)
        is_bent[f] = is_bent[side->second] = 1;
    }
  double bent = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) bent += is_bent[f] ? facets[f].area : 0;
  return bent > 0 ? bent / area_of(facets) : 0;
}

/// Of the geometry; nothing if Gmsh does not know it.
std::optional<double> real_area(int surface) {
  double area = 0;
  const StageLog log = run_logged([&] { ::gmsh::model::occ::getMass(2, surface, area); });
  if (!log.errors.empty() || !(area > 0)) return {};
  return area;
}

bool is_too_coarse(int surface) {
  constexpr double kMuch = 0.4, kTimes = 1.75;
  if (!has_elements(2, surface)) return real_area(surface).has_value();
  const std::vector<Facet> facets = facets_of(surface);
  if (facets.empty()) return false;
  if (bent_share(facets) > kMuch) return true;
  const double area = area_of(facets), real = real_area(surface).value_or(area);
  return area > kTimes * real || real > kTimes * area;
}

}  // namespace

bool is_curved(int surface) {
  const std::string type = entity_type(2, surface);
  return type != "Plane" && type.find("Discrete") == std::string::npos;
}

std::vector<int> find_too_coarse(const std::vector<int>& surfaces) {
  std::vector<int> coarse;
  std::copy_if(surfaces.begin(), surfaces.end(), std::back_inserter(coarse),
               [](int surface) { return is_curved(surface) && is_too_coarse(surface); });
  return coarse;
}

bool ask_for_more(const std::vector<int>& surfaces, std::map<int, int>& times) {
  constexpr int kMost = 4;
  bool asked = false;
  std::map<int, int> more = times;
  for (const int surface : surfaces) {
    ::gmsh::vectorpair curves;
    ::gmsh::model::getBoundary({{2, surface}}, curves, false, false);
    for (const auto& curve : curves) {
      const auto before = times.find(curve.second);
      const int doubled = 2 * (before == times.end() ? 1 : before->second);
      if (doubled > kMost) continue;
      more[curve.second] = doubled;
      asked = true;
    }
  }
  times = std::move(more);
  return asked;
}

}  // namespace qmorph::adapter
