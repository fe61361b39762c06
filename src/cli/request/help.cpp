// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "cli/request/options.hpp"
#include "cli/request/request.hpp"

namespace qmorph::cli {
namespace {

constexpr std::string_view kHelpHead =
    R"(qmorph IN [-o OUT] [options]

Turns the triangles of a Gmsh model into quads (Q-Morph). IN is anything that Gmsh opens: a
geometry (.geo, .step, .brep, ...), which Gmsh meshes with triangles first, or a mesh (.msh of any
version, with or without a geometry), which is taken as it is; further files are merged with it;
- is the standard input. Boundaries, curves, points, physical groups and tags stay.

)";

constexpr std::string_view kHelpTail = R"(
Exit status:
  0  every surface (or every one of --surfaces) consists of quads, but for one triangle in each
     region with an odd number of sides; also where it did so before, and nothing was to be done
  1  the command line makes no sense
  2  the input cannot be opened or meshed; nothing has been written
  3  converted in part: OUT has been written, and the surfaces that are named on stderr are in it as
     they were, or have elements that curved edges turn over
  4  there are no surfaces with elements; nothing has been written
  5  OUT cannot be written; a previous file of that name is as it was
  6  --check: the mesh is not good enough; --for: the reader would not take it, and nothing has been
     written
)";

/// Lines of at most 98 characters, each after two blanks.
std::string wrapped(const std::string& words) {
  std::istringstream in(words);
  std::string text, line;
  for (std::string word; in >> word;) {
    if (line.size() + word.size() > 95) text += "  " + std::exchange(line, "") + '\n';
    line += (line.empty() ? "" : " ") + word;
  }
  return text + "  " + line + '\n';
}

}  // namespace

std::string help_text() {
  std::string text(kHelpHead);
  for (const OurOption& option : our_options()) text += fmt::format("  {:<20} {}\n", option.spelling, option.help);
  text += "\nOf gmsh, with the same meaning; other options of gmsh are refused by name:\n";
  return text + wrapped(passed_gmsh_options()) + std::string(kHelpTail);
}

}  // namespace qmorph::cli
