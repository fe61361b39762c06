// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The stages, one after another, on one region.

#include <chrono>
#include <optional>
#include <string_view>

#include "cleanup/replace_cavities.hpp"
#include "engine/record.hpp"
#include "engine/regions.hpp"
#include "front/decisions.hpp"
#include "kernel/budget.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/error.hpp"
#include "qmorph/options.hpp"
#include "qmorph/report.hpp"

namespace qmorph {

class Pipeline {
 public:
  /// `start` is the region before all stages. Nothing is copied unless the observer of the options wants it.
  /// Improvement ends when all stages together have cost as much work as is allowed (budget.hpp).
  Pipeline(const Options& options, ConversionReport& report, Record& record, const kernel::Mesh& start, double allowed);

  /// Triangles to quads, as far as the front comes. `plane` is for the observer; `decisions`, if not null, is told what
  /// the constants have decided. False if the front has gone astray. \throws Cancelled, as all stages do
  bool advance_front(kernel::Mesh& mesh, const Plane& plane, front::Decisions* decisions = nullptr);
  /// Everything after the front. Takes any mesh of valid triangles and quads.
  void finish(kernel::Mesh& mesh);

  /// finish() is clean() and polish(). In between, parts that were cleaned side by side may be joined; then irregular
  /// nodes near their interfaces cancel.
  void clean(kernel::Mesh& mesh, const cleanup::CavityLimits& limits = {});
  /// After clean() within limits.
  void clean_further(kernel::Mesh& mesh);
  void clean_near(kernel::Mesh& mesh, const std::vector<Index>& interface);
  void polish(kernel::Mesh& mesh);
  /// After polish(), where the boundary is not an interface: cleanup/open_tip.hpp.
  void open_tips(kernel::Mesh& mesh);

 private:
  /// Until all stages together have cost this share of what they may.
  kernel::Budget until(const kernel::Mesh& mesh, double share) const;
  /// The share that they have cost so far.
  double spent(const kernel::Mesh& mesh) const;
  void note(const kernel::Budget& budget) { report_.budgets_spent += budget.is_spent(); }
  void remove_doublet(kernel::Mesh& mesh, Index v) const;
  /// `share` of all stages together; how they compare was measured.
  void progress(std::string_view stage, double share) const;
  /// Adds the time since the stage before to `seconds`.
  void end_stage(Stage stage, const kernel::Mesh& mesh, double& seconds);

  const Options& options_;
  ConversionReport& report_;
  Record& record_;
  const bool keeps_stages_;
  std::chrono::steady_clock::time_point start_;
  const double allowed_;
};

std::size_t count_faces(const kernel::Mesh& mesh, Index degree);

/// What contradicts invariants I4 and I5; empty if nothing does. The stages keep them step by step; this is the last
/// word.
std::optional<SurfaceError> find_fault(const kernel::Mesh& mesh, const Region& region, const Plane& plane);

}  // namespace qmorph
