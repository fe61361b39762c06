// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/canonical/work.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/canonical/numbered.hpp"
#include "engine/canonical/observer.hpp"
#include "engine/overlap.hpp"
#include "qmorph/error.hpp"

namespace qmorph::canonical {
namespace {

/// A bar that never falls, although the work may begin again.
ProgressCallback never_falling(const ProgressCallback& progress, double& highest) {
  if (!progress) return {};
  return [&](std::string_view stage, double share) {
    highest = std::max(highest, share);
    return progress(stage, highest);
  };
}

void put_in_callers_terms(SurfaceRecord& record, const Patch& patch, const Numbered& own,
                          const FrameObserver& observer) {
  for (auto& front : record.fronts) front = observer.callers(std::move(front));
  for (QuadMesh& stage : record.stages) stage = in_callers_terms(stage, patch, own);
  record.normal = own.frame.direction_to_model(record.normal);
  if (own.frame.is_mirrored()) record.normal = -record.normal;
}

}  // namespace

SurfaceWork work_on_numbered(const Patch& patch, const Options& options, Budget& budget, const PatchWork& work) {
  require_sound(patch);
  const std::optional<Numbered> own = numbered(patch);
  double highest = 0;
  Options watched = options;
  watched.progress = never_falling(options.progress, highest);
  if (own) {
    std::optional<FrameObserver> observer;
    Options inside = watched;
    if (options.observer) inside.observer = &observer.emplace(*options.observer, own->frame);
    try {
      SurfaceWork result = work(own->patch, inside, budget);
      result.conversion.mesh = in_callers_terms(result.conversion.mesh, patch, *own);
      if (observer) put_in_callers_terms(result.record, patch, *own, *observer);
      return result;
    } catch (const SurfaceError&) {  // which has our numbers and coordinates: below it is thrown with the caller's
    }
  }
  return work(patch, watched, budget);
}

}  // namespace qmorph::canonical
