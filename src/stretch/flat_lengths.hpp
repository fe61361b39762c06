// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "space/background.hpp"

namespace qmorph::stretch {

/// Lengths that flatten a surface: those given, by side, times the same factor at all sides that meet in a node, so
/// that shapes stay as they are at first order, and the angles around each inner node are a full turn. Such factors
/// exist for every surface that is a disc with or without holes. They are 1 on the outer boundary, and all the same on
/// that of a hole, which turns once the other way round. Discrete conformal equivalence [Springborn08], by Newton's
/// steps. Nothing if the surface is no such disc, or no factors are found. Cost: some sparse factorisations, near
/// linear.
std::vector<double> flat_lengths(const space::Background& surface, std::vector<double> lengths);

}  // namespace qmorph::stretch
