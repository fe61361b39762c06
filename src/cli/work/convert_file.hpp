// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The whole way from a file to a file.

#include "cli/work/call.hpp"

namespace qmorph::cli {

/// \return the exit status. \throws UsageError, InputError, OutputError, ReaderError
int convert_file(const Call& call);

}  // namespace qmorph::cli
