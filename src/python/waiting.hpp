// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Work in a thread of its own, while the calling thread keeps Python responsive: it handles Ctrl-C, calls `progress`,
/// and lets other Python threads run.

#include <pybind11/pybind11.h>

#include <functional>

#include "qmorph/options.hpp"

namespace qmorph::python {

/// Calls `work` with options whose `progress` is ours.
/// \param progress None, or a function that gets a stage's name and the share that is done, 0 to 1; if it returns False
/// or raises, the work ends.
/// \throws what `work` throws, and what a signal's handler or `progress` raises
/// \pre the calling thread holds the interpreter's lock
void work_while_waiting(const Options& options, const pybind11::object& progress,
                        const std::function<void(const Options&)>& work);

}  // namespace qmorph::python
