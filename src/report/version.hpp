// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace qmorph {

/// Of the CMake project, "0.1.0".
inline constexpr const char* kVersion = QMORPH_VERSION;

}  // namespace qmorph
