#pragma once
/// The values that a run has sampled.

#include <mc/estimate/diagnostics/extremes.h>

#include <array>
#include <span>

namespace mc {

/// All values so far of one output.
struct SampledValues {
  Extremes
      averaged; ///< What is averaged: values of the integrand, over the density of their points if that is learned.
  Extremes integrand; ///< The values of the integrand; empty if these are averaged.
  /// 1 / density where the integrand is smallest, and where it is largest.
  std::array<double, 2> weights = {1, 1};

  /// Adds values of the integrand with the inverse densities of their points.
  void add_weighted(std::span<const double> values, std::span<const double> inverse_densities);

  /// Adds the values of another object.
  void merge(const SampledValues& other);
  /// The values, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(averaged, integrand, weights); }
  /// An empty object for values that will be merged into this one.
  SampledValues for_more_values() const { return {averaged.for_more_values(), integrand.for_more_values()}; }
};

} // namespace mc
