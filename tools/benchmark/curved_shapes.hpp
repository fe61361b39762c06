// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Curved surfaces, with triangles that are nearly equilateral.

#include "sheets.hpp"

namespace benchmark {

/// Sheets in z = 0, bent: nodes at the places that `to` gives.
Patch bent(Patch patch, const std::function<Eigen::Vector3d(const Vector2d&)>& to);
/// Onto a cylinder.
std::function<Eigen::Vector3d(const Vector2d&)> roll(double radius);
/// Up and down in both directions.
std::function<Eigen::Vector3d(const Vector2d&)> waves(double length, double height);

/// Of `around` edges; open at both ends.
Patch tube(int around, int rows, double jitter, Random& random);
/// Closed both ways; `along` edges around the hole, on the middle of the tube, and `around` edges around the tube, an
/// even number.
Patch torus(int along, int around, double jitter, Random& random);
/// An octahedron, its edges divided, blown up.
Patch sphere(int edges, double jitter, Random& random);

}  // namespace benchmark
