// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Work side by side. What comes out must never depend on how many threads there are or which is first: the pieces are
/// cut the same way always, and none sees what another writes.

#include <cstddef>
#include <functional>

namespace qmorph::parallel {

/// Runs `work` where for_each_index() has at most so many threads; 0: as many as the machine has.
void with_threads(int threads, const std::function<void()>& work);

/// work(0), ..., work(count - 1), in any order. If some of them throw, the exception of the lowest index is thrown in
/// the end.
void for_each_index(std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace qmorph::parallel
