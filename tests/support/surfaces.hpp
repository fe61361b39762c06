// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Random curved surfaces for the engine, without Gmsh: every seed gives a valid patch, the same one everywhere.

#include <cstdint>

#include "support/domains.hpp"

namespace qmorph::test {

/// Up to about 3000 triangles. Random domains rolled onto cylinders and cones, bent to waves, saddles and caps; tubes
/// along random curves, closed or open; spheres, with holes or whole; tori and double tori; boxes with sharp edges;
/// scans with noise. Turned, scaled, renumbered, turned over.
Domain random_surface(std::uint64_t seed);

/// A domain in the plane, rolled onto a cylinder or, if `tip` is not 0, a cone: `tip` is the sine of its half angle. No
/// triangle turns by much over its length, and nothing meets itself. Angles and lengths along the surface are the
/// domain's, nearly.
Patch rolled(const Patch& flat, double tip, Rng& rng);

/// Closed surfaces with sides of about `size`, their nodes jittered along the surface.
Patch sphere(double size, Rng& rng);
Patch torus(double large, double small, double size, Rng& rng);
Patch double_torus(double size, Rng& rng);
/// Each face a plane of its own; 12 edges are sharp.
Patch box(const Eigen::Vector3d& sides, double size, Rng& rng);
/// Along a curve that bends by random amounts; open at both ends.
Patch tube(double length, double radius, double size, double bend, Rng& rng);

/// How many segments of about `size` make up the length, but at least `least`.
int count_for(double length, double size, int least);

/// Takes out the points that no triangle uses, and numbers the others by their first use.
void drop_unused(Patch& patch);

/// The patch without the triangles whose middle lies in the ball.
Patch pierced(const Patch& patch, const Eigen::Vector3d& centre, double radius);

}  // namespace qmorph::test
