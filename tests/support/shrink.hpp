// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Makes a failing patch small.

#include <functional>

#include "qmorph/patch.hpp"

namespace qmorph::test {

/// Takes triangles, quads, constraints and fixed nodes away, in ever smaller pieces, as long as `fails` still says so.
/// Only valid patches (`broken_inputs`) are tried. About a thousand calls of `fails` for a thousand triangles.
Patch shrunk(Patch patch, const std::function<bool(const Patch&)>& fails);

}  // namespace qmorph::test
