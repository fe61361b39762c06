// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Curved surfaces, with triangles that are nearly equilateral.

#include "sheets.hpp"

namespace benchmark {

/// Bends sheets in z = 0: `to` gives the places of the nodes.
Patch bent(Patch patch, const std::function<Eigen::Vector3d(const Vector2d&)>& to);
/// Bends onto a cylinder.
std::function<Eigen::Vector3d(const Vector2d&)> roll(double radius);
/// Bends up and down in both directions.
std::function<Eigen::Vector3d(const Vector2d&)> waves(double length, double height);

/// A tube of `around` edges, open at both ends.
Patch tube(int around, int rows, double jitter, Random& random);
/// A torus with `along` edges around the hole, at the middle of the tube, and `around` edges around the tube, an even
/// number.
Patch torus(int along, int around, double jitter, Random& random);
/// A sphere: an octahedron with divided edges, inflated.
Patch sphere(int edges, double jitter, Random& random);

}  // namespace benchmark
