// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One run over the surfaces of a model.

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "gmsh/convert/classified.hpp"
#include "gmsh/convert/figures.hpp"
#include "gmsh/convert/jobs.hpp"
#include "gmsh/convert/periodic.hpp"
#include "gmsh/convert/replace.hpp"
#include "gmsh/model/patches.hpp"
#include "qmorph/gmsh.hpp"

namespace qmorph::adapter {

/// What is done to a surface: its triangles are converted, or its quads improved as well, or nothing.
enum class Task { convert, improve, measure };

class Run {
 public:
  /// Reads the current model. \param before what is measured against, by surface
  Run(Task task, const Options& options, ModelReport& report, const std::map<int, Patch>& before);

  void visit(const std::vector<std::uint32_t>& entities);
  /// Gives the model what has been converted.
  void finish();
  const ModelMesh& mesh() const { return model_.mesh; }

 private:
  Job begin_alone(std::uint32_t entity);
  Job begin_family(const PeriodicFamily& family, const std::vector<std::uint32_t>& entities);
  void finish_alone(Job& job);
  void finish_family(Job& job);
  ConvertedSurface read(std::uint32_t entity);
  void settle(ConvertedSurface& converted);
  void settle_image(ConvertedSurface& converted);
  void check(ConvertedSurface& converted, double beside) const;
  void accept(ConvertedSurface converted, SurfaceReport& report);
  void look_at(std::uint32_t entity, SurfaceReport& report);
  void find_faults(const SurfaceMesh& surface, SurfaceReport& report) const;

  const Task task_;
  const Options& options_;
  ModelReport& report_;
  const std::map<int, Patch>& before_;
  ClassifiedMesh model_;
  FixedEdges fixed_edges_;
  std::vector<PeriodicLink> links_;
  std::vector<PeriodicFamily> families_;
  std::set<int> walls_;  ///< between ends of extruded volumes: they have the volumes' nodes
  std::map<std::uint32_t, CommonElement> common_;
  std::vector<Index> local_;
  std::vector<ConvertedSurface> converted_;
  Figures figures_{options_};
};

}  // namespace qmorph::adapter
