#pragma once
/// What a conversion did, and what its result was worth after each stage.

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "qmorph/film.hpp"
#include "qmorph/quality.hpp"

namespace qmorph {

/// The stages in their order. `input` is the mesh before all of them; `smoothing` the rough one by which cleanup judges.
enum class Stage { input, front, elimination, smoothing, cleanup, final_smoothing, repair };
inline constexpr std::size_t kStages = 7;

/// "final smoothing"
const char* name_of(Stage stage);

/// What the mesh was worth after a stage.
struct StageFigures {
  Stage stage = Stage::input;
  double seconds = 0;          ///< of the stage alone
  QualityAccumulator quality;  ///< of everything converted, kept quads too
  /// Each surface as it was then. Empty unless `Options::keep_stages`.
  std::vector<std::shared_ptr<const QuadMesh>> meshes;
};

/// Counts, times and figures of one conversion, or of several (`add`).
struct ConversionStats {
  std::size_t regions = 0;             ///< sets of triangles joined through edges that are no constraints
  std::size_t odd_regions = 0;         ///< regions with an odd number of boundary sides: one triangle stays in each
  std::size_t worse_regions = 0;       ///< of improve(): got worse quads, since triangles had to go
  std::size_t front_quads = 0;         ///< quads that the advancing front made
  std::size_t leftover_triangles = 0;  ///< triangles that the front left to triangle elimination
  double front_seconds = 0;
  double elimination_seconds = 0;
  double cleanup_seconds = 0;
  double smoothing_seconds = 0;
  /// One for each stage, in their order; a stage that was not run has the figures of the one before. Empty unless
  /// `Options::measure_stages`.
  std::vector<StageFigures> stages;
  /// For each inner edge of the result, its length over that of the input's edges nearby (the median of the 12 whose
  /// middles are nearest). Empty unless `Options::measure_stages`.
  std::vector<double> size_ratios;
  /// How the front of each region advanced. Empty unless `Options::record_film`.
  std::vector<std::shared_ptr<const Film>> films;

  /// Adds those of another surface.
  void add(const ConversionStats& other);
};

}  // namespace qmorph
