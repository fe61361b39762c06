// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Keeps what pages, pictures and the file of --stats show of a conversion, while it runs.

#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "qmorph/gmsh.hpp"
#include "qmorph/observer.hpp"
#include "qmorph/quality.hpp"
#include "report/film.hpp"

namespace qmorph::report {

/// What the mesh was worth after a stage.
struct StageFigures {
  Stage stage = Stage::input;
  double seconds = 0;            ///< of the stage alone
  QualityAccumulator quality;    ///< of everything converted, kept quads too
  std::vector<QuadMesh> meshes;  ///< as it was then, if that was asked for
};

/// How a surface was converted, or several.
struct History {
  std::vector<StageFigures> stages;  ///< one for each, in their order, or none
  std::vector<double> size_ratios;   ///< of all inner edges
  std::vector<Film> films;           ///< of the fronts

  /// Adds the figures of another surface; its meshes and films are not wanted together with others.
  void add_figures(const History& other);
};

/// What is to be kept.
struct Wishes {
  bool figures = false;  ///< of each stage
  bool meshes = false;   ///< after each stage; with `figures`
  bool films = false;
  bool any() const { return figures || films; }
};

class Recorder : public Observer {
 public:
  explicit Recorder(const Wishes& wishes) : wishes_(wishes) {}

  /// Null if nothing is known of a surface with this tag.
  const History* find(int surface) const;
  /// The same for a surface that was converted, or that has the quads of one that was.
  const History* find(const SurfaceReport& surface) const;

  std::unique_ptr<FrontObserver> front_starts(const FrontStart& start) override;
  void front_kept(std::size_t surface, std::unique_ptr<FrontObserver> front) override;
  bool wants_stages() const override { return wishes_.figures; }
  void stage_done(const StageView& view) override;

 private:
  const Wishes wishes_;
  std::map<int, History> histories_;
};

}  // namespace qmorph::report
