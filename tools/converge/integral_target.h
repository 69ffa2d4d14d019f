#pragma once
/// Integrals to measure, and the functions that run their replicates.

#include <integrands/expression_integral.h>
#include <integrands/unit_cube_integral.h>
#include <sampling/sampling_methods.h>

#include <mc/run/executor.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace carlo {

/// Independent estimates of one integral.
struct Replicates {
  std::vector<double> values, calls, seconds; ///< CPU seconds of each estimate
  template <class Archive> void archive(Archive& a) { a(values, calls, seconds); }
};

/// Appends replicates.
void append(Replicates& all, const Replicates& more);

/// Replicates first, first + 1, ... of a method with about n evaluations each.
struct ReplicateTask {
  const SamplingMethod* method = nullptr;
  std::uint64_t n = 0, seed = 1, first = 0, count = 0;
  int threads = 0;                           ///< 0: all threads of the machine
  const std::atomic<bool>* cancel = nullptr; ///< when it becomes true, the returned replicates are invalid
  mc::Checkpoint* checkpoint = nullptr;      ///< saves finished replicates, and goes on from them
  mc::Executor executor = {};                ///< who computes them in this process; empty: threads
  std::string name = "replicates";           ///< tells the tasks of a program apart
};

/// An integral and the function that runs its replicates: in this process, or in a separate one for a plugin's
/// integrand.
struct IntegralTarget {
  UnitCubeIntegral integral;
  std::function<Replicates(const ReplicateTask& task)> run;
  bool has_batch = false;  ///< the integrand also accepts many points at once
  bool is_foreign = false; ///< other processes evaluate the integrand
};

/// A target that runs in this process.
///   throws : `run` throws the errors of `evaluate`.
IntegralTarget in_process_target(UnitCubeIntegral integral);

/// Throws Error for an expression that uses no variable over a box with constant bounds. Every method integrates a
/// constant exactly, so there is nothing to compare.
void refuse_constant(const std::string& expression, const ExpressionContext& context);

/// Throws Error for a scene file (.xml) among several words: only one scene is measured at a time.
void refuse_scene_among(const std::vector<std::string>& words);

Replicates run_replicates(const UnitCubeIntegral& e, const ReplicateTask& task);

/// The same for an integrand that other processes evaluate. bind(seconds) returns the integrand for one replicate; it
/// adds the CPU seconds of these processes to `seconds`.
Replicates run_replicates(const std::function<UnitCubeIntegral(double& seconds)>& bind, const ReplicateTask& task);

} // namespace carlo
