// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What a shared library shows: everything else stays hidden (-DBUILD_SHARED_LIBS=ON).

#if defined(__GNUC__)
#define QMORPH_API [[gnu::visibility("default")]]
#else
#define QMORPH_API
#endif
