// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What came out, for programs: the file of --stats.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gmsh/divide/divide.hpp"
#include "gmsh/volumes/volumes.hpp"
#include "qmorph/gmsh.hpp"
#include "report/recorder.hpp"

namespace qmorph::report {

/// What the report cannot know.
struct RunFacts {
  std::string input, output;
  std::vector<std::string> arguments;  ///< of the command line
  int exit_status = 0;
  std::optional<EvenReport> even;      ///< of --all-quad
  adapter::DivisionReport division{};  ///< where Gmsh has meshed a geometry
  EvenReport mended{};                 ///< and what it then took besides
  adapter::VolumeCounts volumes{};
  double open_seconds = 0, mesh_seconds = 0, write_seconds = 0, total_seconds = 0;
};

/// The figures of qmorph/quality.hpp as JSON: for each surface and in total, at the end and after each stage. Keys come
/// always in the same order; numbers are the shortest that read back as the same.
std::string stats_json(const ModelReport& model, const Recorder& recorder, const RunFacts& facts);

}  // namespace qmorph::report
