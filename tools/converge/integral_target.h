#pragma once
/// What is integrated, and by whom.

#include <integrands/unit_cube_integral.h>
#include <sampling/sampling_methods.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace carlo {

/// Independent estimates of one integral.
struct Replicates {
  std::vector<double> values, calls, seconds; ///< CPU seconds each
};

/// Replicates first, first + 1, ... of a way with about n evaluations each.
struct ReplicateTask {
  const SamplingMethod* method = nullptr;
  std::uint64_t n = 0, seed = 1, first = 0, count = 0;
  int threads = 0;                           ///< 0: all of the machine's
  const std::atomic<bool>* cancel = nullptr; ///< set: what is returned means nothing
};

/// An integral, and what runs its replicates: this process, or one of its own for a plugin's integrand.
struct IntegralTarget {
  UnitCubeIntegral integral;
  std::function<Replicates(const ReplicateTask& task)> run;
  bool has_batch = false; ///< the integrand takes many points at once, too
};

/// One that runs in this process.
///   throws : when it runs, what evaluate throws
IntegralTarget in_process_target(UnitCubeIntegral integral);

/// Throws Error for an expression that uses none of the variables of its box, as in "x=0:1,y=-1:2": every way knows a
/// constant exactly, so that there is nothing to compare.
void refuse_constant(const std::string& expression, const std::string& box);

/// Throws Error for a scene file (.xml) among several words: scenes are measured one at a time.
void refuse_scene_among(const std::vector<std::string>& words);

Replicates run_replicates(const UnitCubeIntegral& e, const ReplicateTask& task);

} // namespace carlo
