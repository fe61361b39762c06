// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What readers ask of a model before it is written: changes of the model that are no changes of the mesh.

#include <cstddef>
#include <string>
#include <vector>

namespace qmorph::adapter {

/// Turns surface elements so that neighbours agree, also across surfaces, and flat parts show their front:
/// counterclockwise in the x-y plane, in others towards the axis that they face most. Nothing happens to models with
/// volume elements.
/// \throws InputError for an element of order 3 or more that would have to be turned
/// \return what cannot be, or an empty string
std::string orient_surfaces();

/// Quads of order 2 get 8 nodes in the place of 9: the one in the middle goes.
/// \throws InputError
void drop_middle_nodes();

/// Points that no curve ends in and no surface has lose their element and their node.
void drop_loose_points();

}  // namespace qmorph::adapter
