// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Options by name, and reports and figures as dictionaries, under the names that they have in C++.

#include <pybind11/pybind11.h>

#include "qmorph/options.hpp"
#include "qmorph/quality.hpp"
#include "qmorph/report.hpp"

namespace qmorph::python {

/// Options by the names of `--set` (with underscores for dots), "threads" and "smoothing". \throws UsageError for
/// another name or value
Options options_from(const pybind11::dict& named);

pybind11::dict dict_of(const Quality& quality);
pybind11::dict dict_of(const ConversionReport& report);

}  // namespace qmorph::python
