#pragma once
/// CPU time of threads and processes.

#include <ctime>

namespace mc {

/// Seconds on a clock; 0 if there is no such clock.
inline double clock_seconds(clockid_t clock) {
  timespec t{};
  return clock_gettime(clock, &t) == 0 ? static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec) : 0;
}

/// CPU seconds of this thread.
inline double thread_cpu_seconds() { return clock_seconds(CLOCK_THREAD_CPUTIME_ID); }

} // namespace mc
