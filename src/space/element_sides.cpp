// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/element_sides.hpp"

#include "space/link_sides.hpp"

namespace qmorph::space {

ElementSides::ElementSides(std::size_t nodes, std::span<const std::array<Index, 3>> triangles,
                           std::span<const std::array<Index, 4>> quads, std::span<const Edge> barriers)
    : triangles_(triangles), quads_(quads) {
  const auto ends = [&](Index side) {
    const Index a = node(side);
    return std::pair(a, a == kNone ? kNone : target(side));
  };
  opposite_ = link_sides(nodes, slots(), ends, barriers);
}

}  // namespace qmorph::space
