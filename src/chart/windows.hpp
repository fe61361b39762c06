// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "chart/divide.hpp"
#include "engine/budget.hpp"

namespace qmorph::chart {

/// A disc of faces around some nodes.
struct Window {
  std::vector<Index> faces;
  std::unique_ptr<LaidOut> laid_out;
};

struct WindowSize {
  int reach;           ///< faces from the nodes, in steps across sides
  int margin;          ///< nodes that are so many steps inside are done
  std::size_t most;    ///< faces of a window
  bool apart = false;  ///< a window waits until no other one is nearer to its middle than the margin
};

/// Of a face that is laid flat, or looked at for a round of windows.
inline constexpr std::size_t kWorkToLayOut = 300, kWorkToLook = 20;

/// Windows with no face in common around the nodes that `waiting` marks, and that it does not any more when a window
/// has them well inside, or no window can be laid flat around them. Called until it returns nothing, every node has had
/// its window, or the budget is spent: where nothing lies flat, each node costs many tries.
/// \param is_wall sides that no window crosses
std::vector<Window> take_windows(const SurfaceMesh& mesh, const std::vector<Index>& opposite,
                                 const std::vector<bool>& is_wall, const WindowSize& size, std::vector<char>& waiting,
                                 Budget& budget);

}  // namespace qmorph::chart
