// SPDX-License-Identifier: GPL-2.0-or-later
#include "qmorph/report.hpp"

#include "qmorph/observer.hpp"

namespace qmorph {

const char* name_of(Stage stage) {
  constexpr const char* kNames[kStages] = {"input",   "front",           "elimination", "smoothing",
                                           "cleanup", "final smoothing", "repair"};
  return kNames[std::size_t(stage)];
}

void ConversionReport::add(const ConversionReport& other) {
  regions += other.regions;
  odd_regions += other.odd_regions;
  worse_regions += other.worse_regions;
  layer_quads += other.layer_quads;
  front_quads += other.front_quads;
  leftover_triangles += other.leftover_triangles;
  budgets_spent += other.budgets_spent;
  front_seconds += other.front_seconds;
  elimination_seconds += other.elimination_seconds;
  cleanup_seconds += other.cleanup_seconds;
  smoothing_seconds += other.smoothing_seconds;
  sizes.insert(sizes.end(), other.sizes.begin(), other.sizes.end());
}

}  // namespace qmorph
