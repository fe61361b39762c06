// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What is done to the model between the quads and the file.

#include <string>
#include <vector>

#include "cli/work/call.hpp"
#include "gmsh/read/open.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/write/write.hpp"
#include "qmorph/gmsh.hpp"

namespace qmorph::cli {

/// What comes after the quads: volumes on them, the order of all elements, partitions. Gmsh's warnings go into
/// `opened`, what else there is to say into `model`.
/// \throws InputError, BrokenModel
/// \return what is not as it should be
std::vector<std::string> finish_model(const Call& call, adapter::OpenedModel& opened, adapter::Session& session,
                                      ModelReport& model);

/// Changes of the model that the reader, or the readers of the format, ask for. \throws InputError
void prepare_for_readers(const Call& call, const adapter::OutputPlan& plan);

}  // namespace qmorph::cli
