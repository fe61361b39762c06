#pragma once
/// The stages, one after another, on one region.

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "engine/regions.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"
#include "qmorph/stats.hpp"

namespace qmorph {

/// What a region looked like after each stage.
using Snapshots = std::array<std::optional<kernel::Mesh>, kStages>;

class Pipeline {
 public:
  /// `start` is the region before all stages; `snapshots` may be null, and then nothing is copied.
  Pipeline(const Options& options, ConversionStats& stats, Snapshots* snapshots, const kernel::Mesh& start);

  /// Triangles to quads, as far as the front comes. \return how, in the plane, if `Options::record_film`; else null
  std::shared_ptr<Film> advance_front(kernel::Mesh& mesh);
  /// Everything after the front. Takes any mesh of valid triangles and quads.
  void finish(kernel::Mesh& mesh);

  /// finish() is clean() and polish(). In between, parts that were cleaned side by side may be joined; then irregular nodes near their
  /// interfaces cancel.
  void clean(kernel::Mesh& mesh);
  void clean_near(kernel::Mesh& mesh, const std::vector<Index>& interface);
  void polish(kernel::Mesh& mesh);

 private:
  void remove_doublet(kernel::Mesh& mesh, Index v) const;
  /// `share` of all stages together; how they compare was measured.
  void progress(std::string_view stage, double share) const;
  /// Adds the time since the stage before to `seconds`.
  void end_stage(Stage stage, const kernel::Mesh& mesh, double& seconds);

  const Options& options_;
  ConversionStats& stats_;
  Snapshots* snapshots_;
  std::chrono::steady_clock::time_point start_;
};

/// A film of the plane, turned into where the plane lies.
std::shared_ptr<const Film> in_space(const std::shared_ptr<Film>& film, const Plane& plane);

std::size_t count_faces(const kernel::Mesh& mesh, Index degree);

/// What contradicts invariants I4 and I5, in words; empty if nothing does. The stages keep them step by step;
/// this is the last word.
std::string find_fault(const kernel::Mesh& mesh, const Region& region, const Plane& plane);

}  // namespace qmorph
