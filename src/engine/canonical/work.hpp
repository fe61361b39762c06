// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The same quads for the same surface: what numbers its nodes and elements have, in which of the model's axes it lies
/// and from which side it is seen decides nothing.

#include "engine/surface.hpp"

namespace qmorph::canonical {

/// `work` on the patch as numbered() makes it, and what came of it in the caller's numbers and coordinates. An error is
/// one about the patch as it came.
/// \throws SurfaceError if an index is out of range or an element uses a node twice; what `work` throws
SurfaceWork work_on_numbered(const Patch& patch, const Options& options, Budget& budget, const PatchWork& work);

}  // namespace qmorph::canonical
