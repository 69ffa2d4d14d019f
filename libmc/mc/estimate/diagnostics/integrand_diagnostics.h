#pragma once
/// Diagnostics of the values of an integrand.

#include <mc/core/types.h>
#include <mc/estimate/diagnostics/octave_histogram.h>
#include <mc/estimate/diagnostics/tail_index_estimator.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace mc::detail {

/// Diagnostics of an integrand f: the values that enter the mean, and the tail of f if these values are not f itself.
struct IntegrandDiagnostics {
  OctaveHistogram values = {};  ///< Values that enter the mean.
  TailIndexEstimator tail = {}; ///< Tail of f; empty if the values are f.
  /// Tails of f minus the bounds IntegrationRun::tail_offsets; empty if these are 0.
  std::array<TailIndexEstimator, 2> offset_tails = {};
  /// Values of f at uniform points, if these are only a part of a mixture.
  OctaveHistogram uniform_values = {};
  double lo = infinity<double>, hi = -infinity<double>; ///< Range of f, if points are drawn from a density.
  std::uint64_t infinite_count = 0;                     ///< Number of infinite values.
  /// Volume that the points with infinite values represent, in units in which all points of a run sum to their number.
  double infinite_volume = 0;

  /// Adds the diagnostics of other points.
  void merge(const IntegrandDiagnostics& other) {
    infinite_count += other.infinite_count;
    infinite_volume += other.infinite_volume;
    lo = std::min(lo, other.lo);
    hi = std::max(hi, other.hi);
    values.merge(other.values);
    tail.merge(other.tail);
    for (std::size_t i = 0; i < offset_tails.size(); ++i) offset_tails[i].merge(other.offset_tails[i]);
    uniform_values.merge(other.uniform_values);
  }
  /// Extends the range by the values f.
  void add_to_range(std::span<const double> f) {
    for (const double x : f) {
      lo = std::min(lo, x);
      hi = std::max(hi, x);
    }
  }
  /// Whether f was equal at all points.
  bool constant() const { return tail.empty() ? values.lo() == values.hi() : lo == hi; }
  /// Tail index of f by TailIndexEstimator::index().
  double tail_index() const { return tail.empty() ? TailIndexEstimator(values).index() : tail.index(); }
  /// Tail index that makes the variance infinite, or else the tail index of f.
  double decisive_tail_index() const {
    const double own = tail_index();
    if (!infinite_variance()) return own;
    if (offset_tails[0].infinite_variance()) return offset_tails[0].index();
    return std::isfinite(own) ? own : TailIndexEstimator(uniform_values).index();
  }
  /// Whether the variance of f is infinite. A singular integral may have a large part between neighbouring doubles. A
  /// density that follows f down to neighbouring doubles makes the tail of f look bounded. In that case only the
  /// uniform points reveal the heavy tail. They count under three conditions. There are at least a thousand, because a
  /// steep exponential looks as heavy with fewer. Their index is well below 2, because their estimate is inaccurate.
  /// The largest value under the density is at least 16 times the largest uniform value, in contrast to a ridge that
  /// few uniform points reach.
  bool infinite_variance() const {
    if (infinite_count > 0) return true;
    if (tail.empty() ? TailIndexEstimator(values).infinite_variance() : tail.infinite_variance()) return true;
    if (offset_tails[0].infinite_variance() && offset_tails[1].infinite_variance()) return true;
    if (uniform_values.count() < 1000 || tail.top_exponent() < uniform_values.top_exponent() + 4) return false;
    const TailIndexEstimator of_uniform(uniform_values);
    return of_uniform.infinite_variance() && of_uniform.index() < 1.5;
  }
};

} // namespace mc::detail
