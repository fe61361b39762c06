// SPDX-License-Identifier: GPL-2.0-or-later
// The main function of every test program; compiled once, since doctest's implementation is slow to build.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
