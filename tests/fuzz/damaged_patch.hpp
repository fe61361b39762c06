// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Small valid meshes that are then damaged, as the bytes of a fuzzer say.

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "qmorph/patch.hpp"

namespace qmorph::test {

/// Records of four bytes, so that a changed byte changes one thing. The first says which mesh: a grid of a few cells,
/// square or laid round as a ring or a spiral. Each of the others damages it in one place, or asks for something: a
/// constraint, a quad, a fixed node.
Patch damaged_patch(std::span<const std::uint8_t> bytes);

/// Why a conversion has to be refused, as far as arrays show it: an index out of range, an element with a node twice, a
/// coordinate that is not finite.
std::optional<std::string> why_unsound(const Patch& patch);

/// Whether nothing is promised but an orderly end: for kept quads that are no good themselves, edges of more than two
/// elements, triangles that lie on each other's backs, and sizes so different that numbers of 16 digits do not hold the
/// short edges beside the long ones.
/// \pre it is sound
bool is_promised_nothing(const Patch& patch);

/// Without constraints that are not edges of elements, and without fixed nodes that no element uses: there is nothing
/// to keep.
Patch without_loose_wishes(Patch patch);

/// Where two elements of a result in a plane overlap; its first `kept` quads are the input's own, and nobody has
/// promised anything about them. Every pair is looked at, so for small meshes.
std::optional<std::string> find_overlap(const QuadMesh& mesh, std::size_t kept);

}  // namespace qmorph::test
