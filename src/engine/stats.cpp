#include "qmorph/stats.hpp"

namespace qmorph {

const char* name_of(Stage stage) {
  constexpr const char* kNames[kStages] = {"input",   "front",           "elimination", "smoothing",
                                           "cleanup", "final smoothing", "repair"};
  return kNames[std::size_t(stage)];
}

void ConversionStats::add(const ConversionStats& other) {
  regions += other.regions;
  odd_regions += other.odd_regions;
  worse_regions += other.worse_regions;
  front_quads += other.front_quads;
  leftover_triangles += other.leftover_triangles;
  front_seconds += other.front_seconds;
  elimination_seconds += other.elimination_seconds;
  cleanup_seconds += other.cleanup_seconds;
  smoothing_seconds += other.smoothing_seconds;
  size_ratios.insert(size_ratios.end(), other.size_ratios.begin(), other.size_ratios.end());
  films.insert(films.end(), other.films.begin(), other.films.end());
  if (stages.empty()) {
    stages = other.stages;
    return;
  }
  for (std::size_t i = 0; i < other.stages.size(); ++i) {
    stages[i].seconds += other.stages[i].seconds;
    stages[i].quality.add(other.stages[i].quality);
    stages[i].meshes.insert(stages[i].meshes.end(), other.stages[i].meshes.begin(), other.stages[i].meshes.end());
  }
}

}  // namespace qmorph
