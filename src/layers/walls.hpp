// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Layers on walls.

#include "layers/column.hpp"

namespace qmorph::layers {

/// Layers begin with cells that are so many times longer than high.
inline constexpr double kStart = 2.5;
/// So many cells side by side are a row. Fewer could be triangles of any mesh.
inline constexpr std::size_t kRow = 3;

/// Takes columns on walls, where cells are much longer than high; they go up as far as they look like layers.
std::vector<Column> take_columns_on_walls(Cells& cells);

/// Takes columns on walls beside cells that were found otherwise, and have grown up to the wall.
void go_on_along_walls(Cells& cells);

/// Lets columns grow side by side, a row at a time.
void march(Cells& cells, std::vector<Column>& columns);

/// Takes what lies between two columns on walls that meet at a node, as spokes go on from the triangles at that node.
/// Rows end where those of both columns do.
void take_fans(Cells& cells, const std::vector<Column>& columns);

}  // namespace qmorph::layers
