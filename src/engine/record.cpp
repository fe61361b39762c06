// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/record.hpp"

#include <utility>

namespace qmorph {

void Record::add(Record& part) {
  for (std::size_t i = 0; i < kStages; ++i) seconds[i] += part.seconds[i];
  for (auto& front : part.fronts) fronts.push_back(std::move(front));
  part.fronts.clear();
}

void SurfaceRecord::tell(Observer& observer, std::size_t surface) {
  for (auto& front : fronts) observer.front_kept(surface, std::move(front));
  for (std::size_t i = 0; i < stages.size(); ++i) {
    StageView view{surface, Stage(i), seconds[i], stages[i], normal, {}};
    if (i + 1 == stages.size()) view.size_ratios = size_ratios;
    observer.stage_done(view);
  }
}

}  // namespace qmorph
