// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Prepares a model for those who read its file. The mesh keeps its shape.

#include <cstddef>
#include <string>
#include <vector>

namespace qmorph::adapter {

/// Orients surface elements alike, also across surfaces, so that flat parts are seen from the front: counterclockwise
/// in the x-y plane, elsewhere as seen from the positive side of the axis that they face most. Models with volume
/// elements are left as they are.
/// \throws InputError for an element of order 3 or more that would have to be turned
/// \return what cannot be oriented, or an empty string
std::string orient_surfaces();

/// Quads of order 2 get 8 nodes instead of 9: the one in the middle is removed.
/// \throws InputError
void drop_middle_nodes();

/// Removes the elements and nodes of points that belong to no curve and no surface.
void drop_loose_points();

}  // namespace qmorph::adapter
