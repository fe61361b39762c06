// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Curves of a geometry, divided so that the surfaces between them can be quads.

#include <map>
#include <set>
#include <vector>

namespace qmorph::adapter {

/// What is to be meshed, and what must stay as Gmsh would have it.
struct DivisionTask {
  std::vector<int> surfaces;   ///< to be meshed
  std::set<int> kept_curves;   ///< of which Gmsh's own number stays
  std::set<int> structured{};  ///< transfinite surfaces: their curves' numbers stay
  std::map<int, int> given{};  ///< curves that get this number of segments
  std::map<int, int> times{};  ///< curves that are to be finer, and how many times as many segments they want
};

/// By tags, in order.
struct DivisionReport {
  bool understood = false;           ///< there is no compound, for one
  std::vector<int> more, fewer;      ///< curves that got more or fewer segments than Gmsh gives them
  std::vector<int> fixed;            ///< curves whose number does not depend on the size: transfinite, or of layers
  std::vector<int> told;             ///< curves of which Gmsh has been told a number, and may forget it
  std::vector<int> odd_surfaces;     ///< by their curves
  std::vector<int> coarse_surfaces;  ///< around which curves got more, since their sizes were too large for the surface
  std::map<int, int> segments;       ///< of each curve
};

/// Has Gmsh mesh the curves of the current model: with its own sizes and numbers, apart from the smallest change that
/// gives each surface an even boundary and curves that face each other across a band the same numbers. Where a curve
/// gets another number than Gmsh gave it, its nodes still lie as its sizes are.
/// \pre within run_logged()
DivisionReport divide_curves(const DivisionTask& task);

/// Curves that have another number of segments now, and that number: where the curves are too coarse for a surface,
/// Gmsh divides some further.
std::map<int, int> find_divided_further(const DivisionReport& report);

/// 3 T + 4 Q = 2 E + B: with T triangles, Q quads and E inner edges, the number B of sides is odd where T is. Linear
/// elements only.
bool has_odd_boundary(int surface);

/// Or Gmsh would keep to the numbers when it meshes the curves again. Those of extruded curves it keeps: it would
/// forget that they are.
void forget_division(const DivisionReport& report);

}  // namespace qmorph::adapter
