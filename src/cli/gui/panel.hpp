// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The group "qmorph" in the tree of Gmsh's window: what is to be done, and what has come of it.

#include <string>

#include "cli/request/request.hpp"
#include "qmorph/gmsh.hpp"
#include "report/picture.hpp"

namespace qmorph::cli {

/// What buttons ask for: names of ONELAB's action.
namespace action {
inline constexpr const char* kConvert = "qmorph convert";
inline constexpr const char* kCancel = "qmorph cancel";
inline constexpr const char* kBack = "qmorph triangles";
inline constexpr const char* kPick = "qmorph pick";
inline constexpr const char* kForward = "qmorph forward";
inline constexpr const char* kBackward = "qmorph backward";
inline constexpr const char* kToBegin = "qmorph begin";
inline constexpr const char* kToEnd = "qmorph end";
inline constexpr const char* kSave = "qmorph save";
inline constexpr const char* kReport = "qmorph report";
inline constexpr const char* kFilm = "qmorph film";
inline constexpr const char* kCompare = "qmorph compare";
}  // namespace action

/// Names of parameters.
namespace parameter {
inline constexpr const char* kGroup = "00qmorph/";
inline constexpr const char* kSizeFactor = "00qmorph/01Size factor";
inline constexpr const char* kAllQuad = "00qmorph/02No triangle at all";
inline constexpr const char* kCleanupOnly = "00qmorph/03Clean up only";
inline constexpr const char* kCrease = "00qmorph/04Creases over (degrees)";
inline constexpr const char* kSurfaces = "00qmorph/05Surfaces";
inline constexpr const char* kSmoothing = "00qmorph/07Smoothing";
inline constexpr const char* kColour = "00qmorph/08Colour";
inline constexpr const char* kIrregular = "00qmorph/09Irregular nodes";
inline constexpr const char* kSteps = "00qmorph/20Step/2Steps";
inline constexpr const char* kStepSurface = "00qmorph/20Step/1Surface";
inline constexpr const char* kFrontBy = "00qmorph/20Step/3Front by";
inline constexpr const char* kStepDone = "00qmorph/20Step/8Step";
inline constexpr const char* kStepWords = "00qmorph/20Step/9What it did";
inline constexpr const char* kMeshFile = "00qmorph/40Files/1Mesh file";
inline constexpr const char* kReportFile = "00qmorph/40Files/3Report page";
inline constexpr const char* kFilmFile = "00qmorph/40Files/5Film";
}  // namespace parameter

/// By what the front is coloured while it is watched.
enum class FrontColour { level, state };

/// `kSteps` of this means: until a row is complete.
inline constexpr int kWholeRow = 0;

/// What is chosen but for what a Request has.
struct Choices {
  double size_factor = 1;
  report::PictureColour colour = report::PictureColour::scaled_jacobian;
  bool irregular = true;
  int steps = 1;
  int step_surface = 0;  ///< 0: the first that there is
  FrontColour front = FrontColour::level;
  bool operator==(const Choices&) const = default;
};

/// Puts the group there, or anew where it has gone, with what the command line says.
void define_panel(const Request& request);
bool panel_is_there();

Choices read_choices();

/// The command line's request with what is chosen in its place. \throws UsageError for tags that are none
Request read_request(const Request& of_command_line);

/// The figures of a result; those of nothing without `model`.
void show_figures(const ModelReport* model, double seconds);

}  // namespace qmorph::cli
