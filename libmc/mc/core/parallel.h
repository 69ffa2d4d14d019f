#pragma once
/// Parallel loops with results that do not depend on the number of threads.

#include <cstddef>
#include <functional>
#include <vector>

namespace mc {

/// Number of hardware threads, at least 1.
int hardware_threads();

/// Runs f(i) for every i in [0, n) on up to `threads` threads.
///   threads : 0 means all hardware threads. A number at or above the hardware threads means the threads of the calling
///             TBB arena.
///   throws  : The first exception of f stops the loop: no new i starts, all threads are joined, and the exception is
///             rethrown. Error for negative `threads`.
void parallel_for(std::size_t n, int threads, const std::function<void(std::size_t)>& f);

/// Runs f(begin, end) on consecutive parts of [0, n) with at most `size` elements each, like parallel_for().
template <class F> void parallel_parts(std::size_t n, std::size_t size, int threads, F&& f) {
  parallel_for((n + size - 1) / size, threads,
               [&](std::size_t i) { f(i * size, i * size + size < n ? i * size + size : n); });
}

/// Computes f(chunk) for every chunk in [0, n) in parallel and merges the results in chunk order. The result therefore
/// has the same bits for any number of threads. Result needs a default constructor and merge(const Result&).
template <class Result, class F> Result parallel_reduce(std::size_t n, int threads, F&& f) {
  std::vector<Result> parts(n);
  parallel_for(n, threads, [&](std::size_t i) { parts[i] = f(i); });
  Result total{};
  for (const Result& part : parts) total.merge(part);
  return total;
}

} // namespace mc
