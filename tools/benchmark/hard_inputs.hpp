// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Inputs that tempt a mesher to search for a long time: none may take more than its number of triangles allows.

#include <functional>
#include <string>
#include <vector>

#include "qmorph/patch.hpp"

namespace benchmark {

/// How large an input is to be.
struct Size {
  double share = 1;  ///< of its usual triangles, about
  /// So many rows, columns or edges where the triangles are in proportion to them.
  int along(int usual) const;
  /// The same where there are two such numbers.
  int each_way(int usual) const;
  double each_way(double usual) const;
};

struct HardInput {
  std::string name;  ///< what is hard about it, in a few words
  std::function<std::vector<qmorph::Patch>(const Size&)> make;
};

/// Between 3 000 and 100 000 triangles each, usually.
std::vector<HardInput> hard_inputs();

}  // namespace benchmark
