// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The options of the gmsh program, and what they mean to this one.

#include <string>
#include <string_view>
#include <vector>

namespace qmorph::cli {

enum class GmshOption {
  passed,   ///< Gmsh's own code takes it, with its values
  nothing,  ///< has no effect in Gmsh's batch mode either, or what it asks for is what this program does
  refused,  ///< asks for something else
};

struct GmshOptionRow {
  std::string_view name;  ///< without dash
  int values;             ///< words that follow; -1: a number that says how many, after a name
  GmshOption kind;
  std::string_view note;  ///< passed: what the values are ("positive", "number", "algorithm", "text"); refused: why
};

/// \return null if the gmsh program has no such option
const GmshOptionRow* find_gmsh_option(std::string_view name);

/// Checks values that Gmsh would only complain about, or silently take for 0.
/// \throws UsageError
void check_gmsh_values(const GmshOptionRow& row, const std::vector<std::string>& values);

/// All that are passed on, for the help: "-clextend, -clcurv, ..."
std::string passed_gmsh_options();

/// Whether an option ("clmax", "Mesh.Smoothing") matters only where Gmsh makes elements.
bool says_how_to_mesh(std::string_view name);

}  // namespace qmorph::cli
