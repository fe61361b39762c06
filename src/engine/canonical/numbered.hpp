// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "engine/canonical/frame.hpp"
#include "qmorph/patch.hpp"

namespace qmorph::canonical {

/// A patch in the frame of its shape, its nodes and elements numbered by where they are, each element from its lowest
/// corner on: the same bytes, however the caller has numbered and placed it.
struct Numbered {
  Patch patch;
  Frame frame;
  std::vector<Index> node, quad;  ///< rows of the caller's patch
};

/// Nothing for a patch without elements. The patch is sound (engine/overlap.hpp). Elements that lie exactly upon each
/// other keep the caller's order. Cost: linear, nearly.
std::optional<Numbered> numbered(const Patch& patch);

/// What was made of `from.patch`, in the caller's numbers and coordinates. Nodes that did not move have those of
/// `patch` bit for bit.
QuadMesh in_callers_terms(const QuadMesh& mesh, const Patch& patch, const Numbered& from);

}  // namespace qmorph::canonical
