// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A result in Gmsh's window: elements by colour, marks at irregular nodes, what could not be converted.

#include <vector>

#include "gmsh/window/shown_views.hpp"
#include "report/picture.hpp"
#include "report/scene.hpp"

namespace qmorph::cli {

/// Views of the model's mesh as it is.
/// \param left surfaces that could not be converted
void show_result(const report::Scene& scene, report::PictureColour colour, bool irregular, const std::vector<int>& left,
                 adapter::ShownViews& views);

/// The same for a model whose lines Gmsh does not draw, since it is not the current one, beside the views that are
/// there.
void show_second(const report::Scene& scene, report::PictureColour colour, bool irregular, adapter::ShownViews& views);

/// Colours of report::on_scale() for a view.
std::vector<adapter::Rgb> colours_on_scale(int count);

}  // namespace qmorph::cli
