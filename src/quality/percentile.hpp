// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "qmorph/export.hpp"

namespace qmorph {

/// numpy's default percentile: linear between the two nearest ranks. Reorders `values`, of which there is at least one.
QMORPH_API double percentile(std::vector<double>& values, double percent);

}  // namespace qmorph
