// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The files that are written besides the mesh: figures, pages, pictures.

#include <string>
#include <utility>
#include <vector>

#include "cli/request/request.hpp"
#include "gmsh/read/open.hpp"
#include "gmsh/write/staged_file.hpp"
#include "qmorph/gmsh.hpp"
#include "report/recorder.hpp"
#include "report/scene.hpp"
#include "report/stats.hpp"

namespace qmorph::cli {

/// Those that are asked for: the option and the path.
std::vector<std::pair<std::string, std::string>> side_files(const Request& request);

/// What has to be recorded for them. \throws UsageError for an unknown stage or colour
report::Wishes what_to_keep(const Request& request);

/// A file besides the mesh, and its content.
struct SideFile {
  std::string path, text;
};

/// All of them but views. `before` is the model before it was changed, if a report is asked for.
std::vector<SideFile> make_side_files(const Request& request, const report::Scene& before, const ModelReport& model,
                                      const report::Recorder& recorder, const report::RunFacts& facts);

/// Appends the figures to the mesh where its format has a place for them; else returns the .pos file beside `output`.
/// \param mesh written, not committed
std::vector<SideFile> write_views(const Request& request, const adapter::OpenedModel& opened, const std::string& output,
                                  const adapter::StagedFile& mesh);

/// The mesh and all the other files, or none. \param mesh null if it is in its place already. \throws OutputError
void put_in_place(adapter::StagedFile* mesh, const std::vector<SideFile>& others, adapter::TemporaryNames* names);

}  // namespace qmorph::cli
