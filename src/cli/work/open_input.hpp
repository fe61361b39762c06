// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// From the files that are named on the command line to a model that has triangles.

#include "cli/work/call.hpp"
#include "gmsh/read/open.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/write/write.hpp"

namespace qmorph::cli {

/// Begins the process' session with Gmsh. \throws InputError if an option file or -string is no text of Gmsh's
void begin_session(const Call& call, adapter::Session& session);

/// Opens the input and what is merged with it as --check has it: what is there, and no more. \throws InputError
adapter::OpenedModel open_as_it_is(const Call& call);

/// For a conversion: meshed, with Gmsh's options and the order of elements; warns of what will be ignored.
adapter::OpenedModel open_for_conversion(const Call& call, const adapter::OutputPlan& plan);

}  // namespace qmorph::cli
