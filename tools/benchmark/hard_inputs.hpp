// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Inputs that tempt a mesher to search for a long time: none may take more than its number of triangles allows.

#include <functional>
#include <string>
#include <vector>

#include "qmorph/patch.hpp"

namespace benchmark {

struct HardInput {
  std::string name;  ///< what is hard about it, in a few words
  std::function<std::vector<qmorph::Patch>()> make;
};

/// Between 3 000 and 100 000 triangles each.
std::vector<HardInput> hard_inputs();

}  // namespace benchmark
