// SPDX-License-Identifier: GPL-2.0-or-later
#include "parallel/for_each.hpp"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <vector>

#ifdef __SANITIZE_THREAD__
extern "C" void __tsan_acquire(void*);
extern "C" void __tsan_release(void*);
#endif

namespace qmorph::parallel {
namespace {

// TBB makes sure that the body of a loop sees what was written before it, and that what the body writes is seen
// afterwards. The thread sanitizer does not look into TBB and has to be told.
#ifdef __SANITIZE_THREAD__
char fork;  // its address alone matters: a loop's own data cannot be read before the loop's start is known of
void before_loop() { __tsan_release(&fork); }
void begin_work() { __tsan_acquire(&fork); }
void end_work(void* loop) { __tsan_release(loop); }
void after_loop(void* loop) { __tsan_acquire(loop); }
#else
void before_loop() {}
void begin_work() {}
void end_work(void*) {}
void after_loop(void*) {}
#endif

}  // namespace

void with_threads(int threads, const std::function<void()>& work) {
  const int most = tbb::info::default_concurrency();  // TBB complains on standard error when it is asked for more
  const int wanted = threads == 0 ? most : std::min(threads, most);
  // Inside such a call the threads are shared, not multiplied.
  if (wanted == tbb::this_task_arena::max_concurrency()) return work();
  tbb::task_arena arena(wanted);
  arena.execute(work);
}

void for_each_index(std::size_t count, const std::function<void(std::size_t)>& work) {
  if (count == 1) return work(0);
  std::vector<std::exception_ptr> thrown(count);
  const auto guarded = [&](std::size_t i) {
    begin_work();
    try {
      work(i);
    } catch (...) {
      thrown[i] = std::current_exception();
    }
    end_work(&thrown);
  };
  before_loop();
  tbb::parallel_for(std::size_t(0), count, guarded, tbb::simple_partitioner());
  after_loop(&thrown);
  for (const std::exception_ptr& exception : thrown)
    if (exception) std::rethrow_exception(exception);
}

}  // namespace qmorph::parallel
