#pragma once
/// Helpers for timing tables of librender.

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <vector>

namespace bench {

/// Time [s] on a clock: CLOCK_PROCESS_CPUTIME_ID or CLOCK_THREAD_CPUTIME_ID for CPU time, CLOCK_MONOTONIC for
/// wall-clock time.
inline double seconds_by(clockid_t clock) {
  timespec t;
  clock_gettime(clock, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

} // namespace bench
