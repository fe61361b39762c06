// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What came out, in lines for people.

#include <string>

#include "gmsh/divide/divide.hpp"
#include "gmsh/volumes/volumes.hpp"
#include "qmorph/gmsh.hpp"

namespace qmorph::report {

/// `surface 3 "steel": 4380 triangles -> 2190 quads; scaled Jacobian min 0.478 mean 0.912; irregular 3.9 %; size 1.01
/// along 1.03 across`: lengths over those of the triangles, medians. With layers: `2190 quads, 340 of them in layers`.
std::string surface_line(const SurfaceReport& surface);

/// Of a mesh that was measured: `4380 quads on 3 surfaces; scaled Jacobian min 0.478 mean 0.912; irregular 3.9 %`
std::string check_line(const ModelReport& model);

/// The same for the model, with the seconds of the whole run and the file that it is in now.
std::string total_line(const ModelReport& model, const std::string& output, double seconds);

/// `1 volume: 477 hexahedra, 12 prisms`
std::string volume_line(const adapter::VolumeCounts& volumes);

/// `--all-quad: 2 segments got a node, on curves 4, 7 (3 regions had an odd boundary); surface 3 stays odd`
std::string even_line(const EvenReport& even);

/// Which curves have another number of segments than Gmsh gives them; empty if none has.
std::string division_line(const adapter::DivisionReport& division, const EvenReport& mended);

}  // namespace qmorph::report
