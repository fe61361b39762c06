// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
namespace qmorph::python {

/// Translates our exceptions into those of qmorph/errors.py, with kind, place and subject as attributes. To be called
/// once in each module.
void register_errors();

}  // namespace qmorph::python
