// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Bad elements that moving nodes cannot mend: their connectivity is changed.

#include "kernel/budget.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::cleanup {

/// For every element with a corner sine under `smoothing.target_quality`: tries the changes of cleanup whatever they
/// do to valences, then a layer of quads around the element and its neighbours, which frees corners that
/// lie on a straight piece of boundary. Keeps what raises the smallest sine around clearly.
/// The worst come first where the budget does not last for all. Returns the number of changes.
std::size_t repair(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget = {});

/// For poor elements that this has left, two changes together, since one alone may lead nowhere; kept if they raise the
/// smallest sine around clearly.
std::size_t repair_in_twos(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget = {});

}  // namespace qmorph::cleanup
