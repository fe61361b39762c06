// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Interfaces between parts are boundaries for a while: smooth ones with an even number of sides make good quads.

#include "engine/parts/divide.hpp"

namespace qmorph {

/// Straightens the interfaces through these nodes: nodes that are free go to the middle between their neighbours on the
/// interface, and those around make room.
void straighten_interfaces(kernel::Mesh& mesh, const Division& division, const std::vector<Index>& nodes);

/// Splits interface edges so that one part at most has an odd number of sides, straightens what was split and
/// sets `division.interface`.
void finish_interfaces(kernel::Mesh& mesh, Division& division);

}  // namespace qmorph
