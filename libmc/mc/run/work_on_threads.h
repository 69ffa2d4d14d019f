#pragma once
/// Threads that compute units of a queue.

#include <mc/core/parallel.h>
#include <mc/run/executor.h>

#include <utility>

namespace mc::detail {

/// Computes units on `workers` of this process's threads, until the queue gives out none.
///   queue  : take() waits for a unit, and returns nothing where none is left; deliver(unit, result) takes its result,
///            null where the job gave up; close() lets every take() return nothing.
///   throws : the first exception of the job, after all threads have stopped.
template <class Queue> void work_on_threads(const AnyJob& job, int threads, std::size_t workers, Queue& queue) {
  parallel_for(workers, threads, [&](std::size_t) {
    try {
      while (const std::optional<std::size_t> unit = queue.take()) {
        AnyResult result = job.compute(*unit);
        const bool gave_up = !result;
        queue.deliver(*unit, std::move(result));
        if (gave_up) break;
      }
    } catch (...) {
      queue.close();
      throw;
    }
    queue.close(); // after the last unit, or a cancellation
  });
}

} // namespace mc::detail
