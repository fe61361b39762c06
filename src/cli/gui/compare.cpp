// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/gui/compare.hpp"

#include "cli/files/scene.hpp"
#include "cli/gui/result_view.hpp"
#include "gmsh/window/second_model.hpp"
#include "qmorph/gmsh.hpp"
#include "report/summary.hpp"

namespace qmorph::cli {

std::string compare_with_gmsh(const adapter::Snapshot& triangles, report::PictureColour colour, bool irregular,
                              adapter::ShownViews& views) {
  const adapter::SecondModel second(triangles);
  show_second(read_scene(), colour, irregular, views);
  return "Gmsh's recombine: " + report::check_line(session::measure_surfaces());
}

}  // namespace qmorph::cli
