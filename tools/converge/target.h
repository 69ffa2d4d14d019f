#pragma once
/// What is integrated, and by whom.

#include <integrands/experiments.h>
#include <sampling/ways.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

namespace carlo {

/// Independent estimates of one integral.
struct Replicates {
  std::vector<double> values, calls, seconds; ///< CPU seconds each
};

/// Replicates first, first + 1, ... of a way with about n evaluations each.
struct Task {
  const Way* way = nullptr;
  std::uint64_t n = 0, seed = 1, first = 0, count = 0;
  int threads = 0;                           ///< 0: all of the machine's
  const std::atomic<bool>* cancel = nullptr; ///< set: what is returned means nothing
};

/// An integral, and what runs its replicates: this process, or one of its own for a plugin's integrand.
struct Target {
  Experiment integral;
  std::function<Replicates(const Task& task)> run;
  bool has_batch = false; ///< the integrand takes many points at once, too
};

/// One that runs in this process.
///   throws : when it runs, what evaluate throws
Target here(Experiment integral);

Replicates run_here(const Experiment& e, const Task& task);

} // namespace carlo
