// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What it means in space that an element is valid: every corner turns the way the surface does.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace qmorph::space {

template <std::size_t N>
using Corners = std::array<Eigen::Vector3d, N>;

/// Which way is up for the corners of an element.
template <std::size_t N>
struct CornerNormals {
  Corners<N> at;          ///< of the surface near each corner
  Eigen::Vector3d whole;  ///< of the element: the mean of these and of the one at its centre
};

/// Sines of the corners in space. Negative where the corner is turned over: the cross product of its sides points away
/// from the surface's normal near the corner and from the whole element's. It is enough if one of the two agrees: by
/// the first alone good elements on coarse fillets, where a few triangles turn by a right angle, would be refused. 0
/// for a side without length, -1 where a coordinate is NaN.
template <std::size_t N>
std::array<double, N> corner_sines(const Corners<N>& p, const CornerNormals<N>& normals) {
  std::array<double, N> sines;
  for (std::size_t i = 0; i < N; ++i) {
    const Eigen::Vector3d ahead = p[(i + 1) % N] - p[i], behind = p[(i + N - 1) % N] - p[i];
    const Eigen::Vector3d cross = ahead.cross(behind);
    const double lengths = std::sqrt(ahead.squaredNorm() * behind.squaredNorm());
    const double up = std::max(cross.dot(normals.at[i]), cross.dot(normals.whole));
    const double sine = lengths > 0 ? std::copysign(cross.norm() / lengths, up) : 0;
    sines[i] = std::isnan(lengths) ? -1 : up == 0 ? 0 : sine;
  }
  return sines;
}

/// Cosine between normals below which less than 37 degrees are left between two elements, or halves of one.
constexpr double kFold = -0.8;

/// Two of the quad's sides cross, as where its nodes are not listed in their order around it: along either diagonal one
/// half lies back over the other. Normals of what is around it cannot tell where little is.
inline bool crosses_itself(const Corners<4>& p) {
  const auto is_folded_along = [&](std::size_t i) {
    const Eigen::Vector3d diagonal = p[(i + 2) % 4] - p[i];
    const Eigen::Vector3d a = diagonal.cross(p[(i + 3) % 4] - p[i]), b = (p[(i + 1) % 4] - p[i]).cross(diagonal);
    return a.dot(b) < kFold * a.norm() * b.norm();
  };
  return is_folded_along(0) && is_folded_along(1);
}

/// Cosine between the cross product of a corner's sides and the normal that is nearer to it, the smallest of the
/// element: near 0 it is a matter of chance which way a corner turns.
template <std::size_t N>
double smallest_rise(const Corners<N>& p, const CornerNormals<N>& normals) {
  double least = 1;
  for (std::size_t i = 0; i < N; ++i) {
    const Eigen::Vector3d cross = (p[(i + 1) % N] - p[i]).cross(p[(i + N - 1) % N] - p[i]);
    const double up = std::max(cross.dot(normals.at[i]), cross.dot(normals.whole.normalized())), area = cross.norm();
    least = std::min(least, area > 0 ? up / area : 0);
  }
  return least;
}

/// The smallest of them.
template <std::size_t N>
double scaled_jacobian(const Corners<N>& p, const CornerNormals<N>& normals) {
  const auto sines = corner_sines(p, normals);
  return *std::min_element(sines.begin(), sines.end());
}

/// The same if every corner turns so clearly the way that these normals do that others nearby would say so, too:
/// `clear` is the cosine between a corner's cross product and the normals that is enough for that.
template <std::size_t N>
std::optional<double> clear_jacobian(const Corners<N>& p, const CornerNormals<N>& normals, double clear = 0.5) {
  const double clear_of_whole = clear * normals.whole.norm();
  Corners<N> sides;
  std::array<double, N> squares;
  for (std::size_t i = 0; i < N; ++i) sides[i] = p[(i + 1) % N] - p[i], squares[i] = sides[i].squaredNorm();
  double least = 1;
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t before = (i + N - 1) % N;
    const Eigen::Vector3d cross = sides[before].cross(sides[i]);
    const double area = cross.norm();
    if (!(cross.dot(normals.at[i]) > clear * area) || !(cross.dot(normals.whole) > clear_of_whole * area)) return {};
    least = std::min(least, area / std::sqrt(squares[i] * squares[before]));
  }
  return least;
}

/// Normal of an element by the areas of its halves; zero if there is none.
template <std::size_t N>
Eigen::Vector3d element_normal(const Corners<N>& p) {
  const Eigen::Vector3d area =
      (p[2] - p[0]).cross(p[N - 1] - p[1]);  // of a triangle, p[2] - p[1] is as good as p[2] - p[0]
  const double length = area.norm();
  return length > 0 ? Eigen::Vector3d(area / length) : Eigen::Vector3d::Zero();
}

/// Smallest sine of an element's corners, signed by its own normal: what bends a quad makes it worse. -1 if it has a
/// side or a normal without length.
template <std::size_t N>
double own_sine(const Corners<N>& p) {
  const Eigen::Vector3d normal = element_normal(p);
  double least = 1;
  for (std::size_t i = 0; i < N; ++i) {
    const Eigen::Vector3d ahead = p[(i + 1) % N] - p[i], behind = p[(i + N - 1) % N] - p[i];
    const double lengths = std::sqrt(ahead.squaredNorm() * behind.squaredNorm());
    least = std::min(least, lengths > 0 && !normal.isZero(0) ? ahead.cross(behind).dot(normal) / lengths : -1);
  }
  return least;
}

/// Interior angles in degrees, from 0 to 360, of corners with these signed sines.
template <std::size_t N>
std::array<double, N> corner_angles_deg(const Corners<N>& p, const std::array<double, N>& sines) {
  std::array<double, N> angles;
  for (std::size_t i = 0; i < N; ++i) {
    const Eigen::Vector3d ahead = p[(i + 1) % N] - p[i], behind = p[(i + N - 1) % N] - p[i];
    const double lengths = std::sqrt(ahead.squaredNorm() * behind.squaredNorm());
    const double cosine = lengths > 0 ? ahead.dot(behind) / lengths : 1;
    const double angle = std::atan2(sines[i], cosine + 0.0) * 180 / std::numbers::pi;
    angles[i] = angle < 0 ? angle + 360 : angle;
  }
  return angles;
}

}  // namespace qmorph::space
