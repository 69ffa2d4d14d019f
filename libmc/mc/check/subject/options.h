#pragma once
/// Options of the statistical tests, and of the laws that share them.

#include <cstddef>
#include <cstdint>
#include <functional>

namespace mc {

/// Options of the statistical tests.
struct SubjectOptions {
  std::uint64_t samples = 1'000'000; ///< number of counted samples; pilot_samples(samples) more choose the cells
  std::uint64_t seed = 1;            ///< seed of all random numbers
  /// Probability that a correct subject fails, over all its statistical tests. With the default, a suite of a hundred
  /// correct distributions passes nine times in ten.
  double alpha = 0.001;
  /// Largest number of evaluations of the density. The expected counts use at most a third of it.
  std::size_t max_evaluations = 12'000'000;
  bool evidence = false; ///< keep all counts and intermediate p-values, for pages and plots
  /// Accept faults of measure zero: sample may fail at single values of u, and pdf may be 0 or infinite on boundaries
  /// of the domain.
  bool open_interval = false;
  /// Called before each batch of draws, with their number; an exception that it throws ends the check.
  const std::function<void(std::uint64_t draws)>* before_draws = nullptr;
};

} // namespace mc
