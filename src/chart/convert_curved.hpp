// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "engine/surface.hpp"
#include "space/faults.hpp"

namespace qmorph::chart {

/// convert() and improve() of a patch that is not planar. Regions that no valid quads are found for are left out of the
/// result, and their nodes are marked in `stuck`; if that is null, or there is no hope of any, they are an error.
SurfaceWork convert_curved(const Patch& patch, const Options& options, Budget& budget, std::vector<bool>* stuck);
SurfaceWork improve_curved(const Patch& patch, const Options& options, Budget& budget);

/// Makes a patch into quads. \throws SurfaceError
using CurvedWork = std::function<SurfaceWork(const Patch& patch)>;

/// The work on a curved patch with elements that are turned over among their neighbours, as where two nodes have
/// changed places, once its nodes have been put right. Nothing if there are no such elements, or what comes of it has
/// some.
/// \param kept quads of the patch that stay, and that nodes of do not move: the first ones
std::optional<SurfaceWork> work_put_right(const Patch& patch, std::size_t kept, const Options& options,
                                          const CurvedWork& work);

/// \throws SurfaceError for one of space::find_suspects() that is turned over among its neighbours
void require_none_turned(const Patch& patch, const QuadMesh& mesh, std::size_t kept,
                         std::vector<space::Suspect> suspects);

}  // namespace qmorph::chart
