#include <mc/core/parallel.h>

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace mc {

int hardware_threads() { return std::max(1, tbb::info::default_concurrency()); }

void parallel_for(std::size_t n, int threads, const std::function<void(std::size_t)>& f) {
  if (threads == 1 || n < 2) {
    for (std::size_t i = 0; i < n; ++i) f(i);
    return;
  }
  // TBB cancels the group on the first exception and rethrows it here.
  tbb::task_arena arena(threads > 0 ? threads : hardware_threads());
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, n, f, tbb::simple_partitioner{}); });
}

} // namespace mc
