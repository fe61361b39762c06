// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What a conversion did.

#include <cstddef>

namespace qmorph {

/// Counts and times of one conversion, or of several (`add`). Times are in seconds of the clock, of all regions together.
struct ConversionReport {
  std::size_t regions = 0;             ///< sets of triangles joined through edges that are no constraints
  std::size_t odd_regions = 0;         ///< regions with an odd number of boundary sides: one triangle stays in each
  std::size_t worse_regions = 0;       ///< of improve(): got worse quads, since triangles had to go
  std::size_t front_quads = 0;         ///< quads that the advancing front made
  std::size_t leftover_triangles = 0;  ///< triangles that the front left to triangle elimination
  /// Improvements that ended before they were done, since they had cost as much as their triangles allow: the result is valid, but
  /// could be better.
  std::size_t budgets_spent = 0;
  double front_seconds = 0;
  double elimination_seconds = 0;
  double cleanup_seconds = 0;
  double smoothing_seconds = 0;

  /// Adds those of another surface.
  void add(const ConversionReport& other);
};

}  // namespace qmorph
