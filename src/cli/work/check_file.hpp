// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// --check: judges a mesh that is there.

#include "cli/work/call.hpp"

namespace qmorph::cli {

/// \return the exit status. \throws InputError, OutputError
int check_file(const Call& call);

}  // namespace qmorph::cli
