// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The mesh, on its way to the file.

#include <string>
#include <vector>

#include "cli/request/request.hpp"
#include "gmsh/read/open.hpp"
#include "gmsh/write/write.hpp"
#include "qmorph/gmsh.hpp"

namespace qmorph::cli {

/// What a reader would not take, and why.
struct ReaderError {
  std::vector<std::string> complaints;
};

/// Nothing has changed: the output is to be the input, byte for byte.
bool is_as_it_was(const Request& request, const adapter::OutputPlan& plan, const adapter::OpenedModel& opened,
                  const ModelReport& model);

/// No surface with elements is in a physical group, and there are groups.
InputError no_quad_written(const std::string& output);

/// Takes out of the figures what will not be in the file. \throws InputError if nothing is left
void keep_written(const std::vector<int>& unwritten, const std::string& output, ModelReport& model);

/// Writes the mesh to a file beside its place. \throws ReaderError, OutputError
/// \return false if the output is the input and stays what it is
bool write_mesh(const Request& request, const adapter::OutputPlan& plan, const adapter::OpenedModel& opened,
                bool as_it_was, adapter::StagedFile& file);

}  // namespace qmorph::cli
