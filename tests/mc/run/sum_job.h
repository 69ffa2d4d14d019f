#pragma once
// A job for the tests of executors.

#include <mc/random/hash.h>
#include <mc/run/job.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace support {

inline double uniform(std::uint64_t x) { return double(mc::mix64(x) >> 11) * 0x1p-53; }

/// Sums random numbers in stages; the number of units of a stage depends on the sum before it, as after a pilot. The
/// sum of doubles shows every change of their order.
struct SumJob {
  using Result = std::vector<double>;

  std::uint64_t seed = 1;
  std::uint64_t stages = 6;
  std::function<void(std::size_t unit)> before = {};
  std::uint64_t stage = 0;
  double sum = 0;
  std::uint64_t absorbed = 0;
  mutable std::atomic<int> computed = 0;

  std::size_t next_stage() {
    if (stage == stages) return 0;
    ++stage;
    return 1 + std::size_t(100 * (sum - std::floor(sum)));
  }
  std::optional<Result> compute(std::size_t unit) const {
    if (before) before(unit);
    ++computed;
    return Result{uniform(mc::hash(seed, stage, unit)), 1e-9 * uniform(mc::hash(seed, stage, unit, 1))};
  }
  void absorb(std::size_t, const Result& r) {
    for (const double x : r) sum += x;
    ++absorbed;
  }
  template <class Archive> void archive(Archive& a) { a(stage, sum, absorbed); }
};

inline double expected_sum(std::uint64_t seed) {
  SumJob job{.seed = seed};
  for (std::size_t units; (units = job.next_stage()) > 0;)
    for (std::size_t i = 0; i < units; ++i) job.absorb(i, *job.compute(i));
  return job.sum;
}

/// The same with a number of units that is known, so that parts may skip units: only every third stage needs results.
struct SkippedJob : SumJob {
  std::size_t next_stage() { return stage == stages ? 0 : 10 + ++stage; }
  void skip(std::size_t) {}
  bool needs_results() const { return stage % 3 == 0; }
};

} // namespace support
