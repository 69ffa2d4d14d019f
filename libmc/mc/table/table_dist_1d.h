#pragma once
/// A piecewise constant distribution on an interval.

#include <mc/domain/interval.h>
#include <mc/table/cdf.h>
#include <mc/table/concept.h>
#include <mc/warp/concept.h>

#include <algorithm>

namespace mc {

/// n cells of equal width on [lo, hi], each chosen with probability proportional to its weight, uniform within: a
/// DiscreteDistribution by index and an InvertibleWarp by point.
///   sample : u -> cell i with cdf(i) <= u < cdf(i+1), then linear within it
///   pdf    : pmf(i) n / (hi - lo) [1/length]; 0 outside and in cells of weight 0
///   invert : |invert(sample(u)) - u| <= 4 eps for points that round to the cell they were drawn in
///   throws : Error for no weights, a weight that is not finite and >= 0, or all weights 0
///   Source : inverse transform sampling; see Cdf for the bounds
template <Real S> class TableDist1D {
 public:
  using Scalar = S;
  using Domain = Interval<S>;

  explicit TableDist1D(std::span<const double> weights, Interval<S> interval = {}) : cdf_(weights), interval_(interval) {}

  /// Weights f(x) at the middle of each of n cells.
  template <class F> static TableDist1D from_function(F&& f, std::size_t n, Interval<S> interval = {}) {
    std::vector<double> weights(n);
    for (std::size_t i = 0; i < n; ++i) weights[i] = static_cast<double>(f(interval.from_unit(S((static_cast<double>(i) + 0.5) / static_cast<double>(n)))));
    return TableDist1D(weights, interval);
  }

  DiscreteSample<S> sample_index(S u) const {
    const std::size_t i = cdf_.find(static_cast<double>(u));
    const double remapped = (static_cast<double>(u) - cdf_.cdf(i)) / cdf_.pmf(i);
    using std::min;
    return {i, S(cdf_.pmf(i)), min(S(remapped), one_minus_epsilon<S>)};
  }
  S pmf(std::size_t i) const { return S(cdf_.pmf(i)); }
  std::size_t size() const { return cdf_.size(); }

  Domain domain() const { return interval_; }
  S sample(S u) const {
    const std::size_t i = cdf_.find(static_cast<double>(u));
    const S low = S(cdf_.cdf(i)), within = (u - low) / S(cdf_.pmf(i));
    using std::max, std::min;
    const S n = S(static_cast<double>(size())), cell = S(static_cast<double>(i));
    // Rounding must not carry the point into the next cell, which may have weight 0.
    S v = (cell + min(max(within, S(0)), one_minus_epsilon<S>)) / n;
    if constexpr (std::floating_point<S>)
      while (cell_of(v) > i) v = std::nextafter(v, S(0));
    return interval_.from_unit(v);
  }
  S pdf(S x) const {
    if (!interval_.contains(x)) return S(0);
    return S(cdf_.pmf(cell_of(interval_.to_unit(x)))) * S(static_cast<double>(size())) / interval_.jacobian(S(0));
  }
  S invert(S x) const {
    const S v = interval_.to_unit(x);
    const std::size_t i = cell_of(v);
    return S(cdf_.cdf(i)) + (v * S(static_cast<double>(size())) - S(static_cast<double>(i))) * S(cdf_.pmf(i));
  }
  template <Real T> TableDist1D<T> cast() const { return TableDist1D<T>(cdf_, interval_.template cast<T>()); }

  const Cdf& cdf() const { return cdf_; }

 private:
  template <Real T> friend class TableDist1D;
  TableDist1D(Cdf cdf, Interval<S> interval) : cdf_(std::move(cdf)), interval_(interval) {}

  std::size_t cell_of(S v) const {
    return std::min(static_cast<std::size_t>(static_cast<double>(v * S(static_cast<double>(size())))), size() - 1);
  }

  Cdf cdf_;
  Interval<S> interval_;
};

} // namespace mc
