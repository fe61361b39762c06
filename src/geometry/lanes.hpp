// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Four numbers at a time.

#include <cstddef>  // with __GLIBC__

namespace qmorph {

/// The processor works on all four at once, or on two and two: each lane has the same value either way. The alignment
/// is stated because it would depend on the processor otherwise.
using FourLanes = double __attribute__((vector_size(32), aligned(32)));

}  // namespace qmorph

/// Before a function that is worth compiling twice: for processors with vectors of 256 bits, and for all others. Which
/// one is called is decided when the program is loaded; the thread sanitizer does not survive that.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__SANITIZE_THREAD__)
#define QMORPH_WIDE [[gnu::target_clones("avx2", "default")]]
#else
#define QMORPH_WIDE
#endif
