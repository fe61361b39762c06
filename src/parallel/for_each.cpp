// SPDX-License-Identifier: GPL-2.0-or-later
#include "parallel/for_each.hpp"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <vector>

namespace qmorph::parallel {

void with_threads(int threads, const std::function<void()>& work) {
  const int most = tbb::info::default_concurrency();  // TBB complains on standard error when it is asked for more
  const int wanted = threads == 0 ? most : std::min(threads, most);
  // Inside of such a call the threads are shared, not multiplied.
  if (wanted == tbb::this_task_arena::max_concurrency()) return work();
  tbb::task_arena arena(wanted);
  arena.execute(work);
}

void for_each_index(std::size_t count, const std::function<void(std::size_t)>& work) {
  if (count == 1) return work(0);
  std::vector<std::exception_ptr> thrown(count);
  const auto guarded = [&](std::size_t i) {
    try {
      work(i);
    } catch (...) {
      thrown[i] = std::current_exception();
    }
  };
  tbb::parallel_for(std::size_t(0), count, guarded, tbb::simple_partitioner());
  for (const std::exception_ptr& exception : thrown)
    if (exception) std::rethrow_exception(exception);
}

}  // namespace qmorph::parallel
