// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What a mesh of quads is worth, if several are to choose from.

#include <algorithm>

#include "kernel/mesh.hpp"

namespace qmorph {

/// Quads take the place of so many equilateral triangles with sides as long: 4 / sqrt(3).
inline constexpr double kTrianglesPerQuad = 2.31;
/// With more quads than that, by this factor, a mesh is finer than asked for.
inline constexpr double kFairGrowth = 1.25;

struct Worth {
  double least = 1;   ///< smallest scaled Jacobian of a quad
  double mean = 0;    ///< of shapes
  double growth = 0;  ///< quads over those that take the place of equilateral triangles with sides as long
  /// From where on the worst quad counts for little, and how little.
  double good_enough = kGoodEnough, little = 0.2;
  /// Once the worst quad is good enough for every solver, it counts for little, and the others count. Many quads that
  /// are smaller than asked for have good shapes easily, so growth counts against a result.
  double sum() const {
    return std::min(least, good_enough) + little * std::clamp(least - good_enough, 0.0, kFine - good_enough) +
           2 * mean - std::max(0.0, growth - kFairGrowth);
  }
  bool is_poor() const { return least < kFine; }
  static constexpr double kGoodEnough = 0.5, kFine = 0.7;
  static constexpr double kGoodEnoughInChart = 0.4;  ///< of a curved surface: in space the worst quad will be another
};

/// `triangles`: how many the region had.
Worth worth_of(const kernel::Mesh& mesh, std::size_t triangles);

/// Scaled Jacobians below which solvers complain, and that are fair.
inline constexpr double kRefused = 0.3, kFair = 0.5;

/// In all; but a mesh that is finer than asked for is better than a quad that solvers refuse, up to a limit.
bool is_worth_more(const Worth& one, const Worth& other);

/// In all, and not by a quad that is poorer than the others' worst.
bool is_better(const Worth& one, const Worth& other);

/// Of the smallest scaled Jacobians of the faces.
double mean_sine(const kernel::Mesh& mesh);

/// Quads with a scaled Jacobian below that.
std::size_t count_poor(const kernel::Mesh& mesh, double sine);

/// Whether a node inside has another number of edges than four.
bool has_irregular_nodes(const kernel::Mesh& mesh);

}  // namespace qmorph
