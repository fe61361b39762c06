// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What is worked on, and its way through the engine.

#include <cstdint>
#include <vector>

#include "gmsh/convert/periodic.hpp"
#include "gmsh/convert/replace.hpp"
#include "gmsh/model/model_mesh.hpp"
#include "qmorph/convert.hpp"
#include "qmorph/gmsh.hpp"

namespace qmorph::adapter {

/// What is worked on as a unit: a surface, or surfaces that are periodic with one another, of which the first is
/// converted and the others are its images.
struct Job {
  const PeriodicFamily* family = nullptr;
  std::vector<std::uint32_t> entities{};
  std::vector<ConvertedSurface> converted{};
  std::vector<SurfaceReport> reports{};
  bool is_left_alone = false;  ///< nothing to do, or a reason not to
};

/// A report of a surface as it is, which has been left so far.
SurfaceReport begin_report(const ModelMesh& mesh, std::uint32_t entity);

/// Reports that a surface is left as it was, and why.
void leave(SurfaceReport& report, const SurfaceError& error);

/// The surface `culprit` of the job's family has a reason to stay as it is, and the others have none but that.
void leave_family(Job& job, std::size_t culprit, const SurfaceError& error, const ModelMesh& mesh);

/// For errors about a surface of the model.
ErrorSubject surface_tag(int tag);

/// convert_all() or improve_all().
using Engine = std::vector<Outcome> (*)(const std::vector<const Patch*>& patches, const Options& options);

/// Surfaces side by side; of a family the first. Observers and errors speak of tags. \throws what the engine throws
void run_engine(std::vector<Job>& jobs, Engine engine, const Options& options, const ModelMesh& mesh);

}  // namespace qmorph::adapter
