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

/// What a run saw of an integrand: the values that it adds up, and the tail of f where those are not f itself.
struct IntegrandDiagnostics {
  OctaveHistogram values = {};
  TailIndexEstimator tail = {};
  std::array<TailIndexEstimator, 2> offset_tails =
      {}; ///< of f less the bounds of a constant, see IntegrationRun::floors; empty where that is 0
  OctaveHistogram uniform_values = {};                  ///< of f, where uniform points are but a part of a mixture
  double lo = infinity<double>, hi = -infinity<double>; ///< of f, where points are drawn from a density
  std::uint64_t infinite_count = 0;                     ///< values that were
  double infinite_volume = 0; ///< that their points stand for, where all of a run stand for their number

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
  void add_to_range(std::span<const double> f) {
    for (const double x : f) {
      lo = std::min(lo, x);
      hi = std::max(hi, x);
    }
  }
  /// Whether f was the same at all points.
  bool constant() const { return tail.empty() ? values.lo() == values.hi() : lo == hi; }
  double tail_index() const { return tail.empty() ? TailIndexEstimator(values).index() : tail.index(); }
  /// The index that makes the variance infinite, or that of the tail.
  double decisive_tail_index() const {
    const double own = tail_index();
    if (!infinite_variance()) return own;
    if (offset_tails[0].infinite_variance()) return offset_tails[0].index();
    return std::isfinite(own) ? own : TailIndexEstimator(uniform_values).index();
  }
  /// Two points so near that doubles cannot tell them apart may hold much of a singular integral. Where a density was
  /// learned the uniform points alone may show it, too: a density that follows f down to neighbouring doubles makes the
  /// end of these look like the end of a tail. They count from a thousand on, since to fewer a steep exponential looks
  /// as heavy, only where their index is well below 2, since they do not show it well, and only where values went on
  /// growing under the density, by 16 at least: of a ridge that few uniform points meet they do not.
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
