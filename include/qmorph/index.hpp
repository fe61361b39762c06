// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <limits>

namespace qmorph {

using Index = std::uint32_t;
inline constexpr Index kNone = std::numeric_limits<Index>::max();

}  // namespace qmorph
