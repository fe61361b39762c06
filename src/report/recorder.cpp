// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/recorder.hpp"

#include <utility>

namespace qmorph::report {

void History::add_figures(const History& other) {
  size_ratios.insert(size_ratios.end(), other.size_ratios.begin(), other.size_ratios.end());
  if (stages.size() < other.stages.size()) stages.resize(other.stages.size());
  for (std::size_t i = 0; i < other.stages.size(); ++i) {
    stages[i].stage = other.stages[i].stage;
    stages[i].seconds += other.stages[i].seconds;
    stages[i].quality.add(other.stages[i].quality);
  }
}

const History* Recorder::find(int surface) const {
  const auto found = histories_.find(surface);
  return found == histories_.end() ? nullptr : &found->second;
}

const History* Recorder::find(const SurfaceReport& surface) const {
  if (surface.outcome != SurfaceOutcome::converted) return nullptr;
  return find(surface.image_of != 0 ? surface.image_of : surface.tag);
}

std::unique_ptr<FrontObserver> Recorder::front_starts(const FrontStart& start) {
  if (!wishes_.films) return nullptr;
  return std::make_unique<FilmRecorder>(start);
}

void Recorder::front_kept(std::size_t surface, std::unique_ptr<FrontObserver> front) {
  histories_[int(surface)].films.push_back(static_cast<FilmRecorder&>(*front).finish());
}

void Recorder::stage_done(const StageView& view) {
  History& history = histories_[int(view.surface)];
  history.stages.resize(kStages);
  StageFigures& figures = history.stages[std::size_t(view.stage)];
  figures.stage = view.stage;
  figures.seconds += view.seconds;
  QualityAccumulator quality;
  if (view.normal.isZero())
    quality.add(view.mesh.points, view.mesh.triangles, view.mesh.quads);
  else
    quality.add(view.mesh.points, view.mesh.triangles, view.mesh.quads, view.normal);
  figures.quality.add(quality);
  if (wishes_.meshes) figures.meshes.push_back(view.mesh);
  history.size_ratios.insert(history.size_ratios.end(), view.size_ratios.begin(), view.size_ratios.end());
}

}  // namespace qmorph::report
