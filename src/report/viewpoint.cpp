// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/viewpoint.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

namespace qmorph::report {
namespace {

constexpr Turn kFromSideAndAbove{-0.5, 0.6};
/// A direction nearer to the upward axis than this (cosine) has no side that is above.
constexpr double kAlongUp = 0.9999;

std::optional<Viewpoint> axis_of(std::string_view name) {
  const double sign = name.front() == '-' ? -1 : 1;
  if (name.front() == '-' || name.front() == '+') name.remove_prefix(1);
  if (name.size() != 1 || name[0] < 'x' || name[0] > 'z') return std::nullopt;
  return Viewpoint(sign * Viewpoint::Unit(name[0] - 'x'));
}

}  // namespace

std::optional<Viewpoint> find_viewpoint(std::string_view name) {
  if (name.empty()) return std::nullopt;
  if (const auto axis = axis_of(name)) return axis;
  Viewpoint from;
  const char *at = name.data(), *end = name.data() + name.size();
  for (int i = 0; i < 3; ++i) {
    if (i > 0 && (at == end || *at++ != ',')) return std::nullopt;
    const auto [next, error] = std::from_chars(at, end, from[i]);
    if (error != std::errc() || !std::isfinite(from[i])) return std::nullopt;
    at = next;
  }
  if (at != end || from.isZero()) return std::nullopt;
  return Viewpoint(from.stableNormalized());
}

Eigen::Matrix3d Turn::rows() const {
  return (Eigen::AngleAxisd(right, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(up, Eigen::Vector3d::UnitY()))
      .toRotationMatrix();
}

Turn turn_of(const Frame& frame, const Viewpoint& from) {
  if (from.isZero()) return frame.flat ? Turn{} : kFromSideAndAbove;
  const Eigen::Vector3d eye = Eigen::Vector3d(from.dot(frame.right), from.dot(frame.up), from.dot(frame.normal()));
  const double height = std::clamp(eye.normalized().y(), -1.0, 1.0);
  return {std::abs(height) > kAlongUp ? 0 : std::atan2(-eye.x(), eye.z()), std::asin(height)};
}

}  // namespace qmorph::report
