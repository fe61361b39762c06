// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Meshes as drawings.

#include <optional>
#include <string>
#include <string_view>

#include "qmorph/gmsh.hpp"
#include "report/drawing.hpp"
#include "report/recorder.hpp"
#include "report/scene.hpp"
#include "report/viewpoint.hpp"

namespace qmorph::report {

/// By what elements are coloured. `none`: lines alone.
enum class PictureColour { scaled_jacobian, eta, thesis_metric, size, none };

/// sj, eta, thesis, size or none.
std::optional<PictureColour> find_picture_colour(std::string_view name);

/// Draws a scene, its longer side 400 points: faces by colour, their sides, boundary and curves, nodes with other than
/// four edges (three: orange triangle, five: blue pentagon, others: black disc). Of a scene in space, or of a flat one
/// that is looked at from elsewhere, what is hidden is left out; without colours its faces are in the light of a lamp
/// at the eye. Sizes are coloured by their logarithm between the smallest and the largest.
Drawing draw(const Scene& scene, PictureColour colour, const Viewpoint& from = Viewpoint::Zero());

/// The scene with its surfaces as they were after a stage. \pre the recorder has kept the meshes of the stages.
/// Surfaces that were not converted, or are images of others that are periodic with them, are as in `after`.
Scene at_stage(const Scene& after, const ModelReport& model, const Recorder& recorder, Stage stage);

}  // namespace qmorph::report
