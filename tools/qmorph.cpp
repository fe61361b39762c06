// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/apart.hpp"

int main(int argc, char** argv) { return qmorph::cli::run_apart({argv + 1, argv + argc}); }
