#include <mc/core/error.h>
#include <mc/core/parallel.h>

#include <algorithm>

// libtbb is not built for the thread sanitizer, which therefore cannot follow its synchronisation. Builds for that
// sanitizer use plain threads instead.
#if defined(__SANITIZE_THREAD__)
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#else
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace mc {

namespace {

#if defined(__SANITIZE_THREAD__)
int available_threads() { return static_cast<int>(std::thread::hardware_concurrency()); }

void for_all(std::size_t n, int threads, const std::function<void(std::size_t)>& f) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr first;
  std::mutex mutex;
  const auto work = [&] {
    try {
      for (std::size_t i; (i = next++) < n;) f(i);
    } catch (...) {
      next = n;
      const std::lock_guard lock(mutex);
      if (!first) first = std::current_exception();
    }
  };
  std::vector<std::jthread> pool;
  for (int i = 1; i < threads; ++i) pool.emplace_back(work);
  work();       // as with TBB; a thread that only waits would not see signals
  pool.clear(); // joins the threads
  if (first) std::rethrow_exception(first);
}
#else
int available_threads() { return tbb::info::default_concurrency(); }

void for_all(std::size_t n, int threads, const std::function<void(std::size_t)>& f) {
  // TBB cancels the group on the first exception and rethrows it here.
  const auto loop = [&] { tbb::parallel_for(std::size_t{0}, n, f, tbb::simple_partitioner{}); };
  using tbb::global_control;
  const std::size_t limit = global_control::active_value(global_control::max_allowed_parallelism);
  // Entering a separate arena is slow for its threads, so the loop runs in the current arena if that has no more
  // threads than allowed. Isolation keeps a thread that waits for this loop from starting unrelated tasks.
  if (static_cast<std::size_t>(threads) >= limit) tbb::this_task_arena::isolate(loop);
  else tbb::task_arena(threads).execute(loop);
}
#endif

} // namespace

int hardware_threads() { return std::max(1, available_threads()); }

void parallel_for(std::size_t n, int threads, const std::function<void(std::size_t)>& f) {
  require(threads >= 0, "threads {} must be >= 0; 0 stands for all of the machine's", threads);
  if (threads == 1 || n < 2) {
    for (std::size_t i = 0; i < n; ++i) f(i);
    return;
  }
  for_all(n, threads > 0 ? threads : hardware_threads(), f);
}

} // namespace mc
