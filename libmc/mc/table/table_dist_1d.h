#pragma once
/// A piecewise constant distribution on an interval.

#include <mc/domain/interval.h>
#include <mc/table/cdf.h>
#include <mc/table/concept.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace mc {

/// The interval [0,1] as a type. Code of a table on it needs no division by the width.
struct UnitInterval {
  static constexpr int lo = 0, ///< Lower end.
      hi = 1;                  ///< Upper end.
};

/// Interior ends of n cells of equal width on [0,1].
inline std::vector<double> even_breaks(std::size_t n) {
  std::vector<double> breaks;
  for (std::size_t i = 1; i < n; ++i) breaks.push_back(static_cast<double>(i) / static_cast<double>(n));
  return breaks;
}

/// The geometry of TableDist1D: n cells of equal width on an interval. Refers to a cumulative table stored elsewhere.
template <Real S, class I = Interval<S>> struct PiecewiseConstantView {
  CdfView cdf;                      ///< Cumulative table.
  [[no_unique_address]] I interval; ///< Interval of the cells.

  /// Outcome with an interval that contains u.
  std::size_t find(S u) const { return cdf.find(static_cast<double>(u)); }
  /// Relative position of u in the interval of outcome i, in [0,1).
  S remapped(S u, std::size_t i) const { return clamp_to_unit(S(within(u, i))); }
  /// Point at the relative position of u in cell i.
  S point(S u, std::size_t i) const {
    const Wide v = (index(i) + within(u, i)) / index(cdf.size());
    S x;
    if constexpr (std::same_as<I, UnitInterval>) x = S(v);
    else x = std::clamp(S(Wide(interval.lo) * (1 - v) + Wide(interval.hi) * v), S(interval.lo), S(interval.hi));
    return !std::floating_point<S> || cell(x) == i ? x : nudged(x, i);
  }
  /// Density in cell i [1/length].
  S density(std::size_t i) const {
    return S(Wide(cdf.pmf(i)) * index(cdf.size()) / (Wide(interval.hi) - Wide(interval.lo)));
  }
  /// The u that maps to x.
  S invert(S x) const {
    const std::size_t i = cell(x);
    return clamp_to_unit(S(Wide(cdf.cdf(i)) + (unit(x) * index(cdf.size()) - index(i)) * Wide(cdf.pmf(i))));
  }
  /// Cell that contains x; the outermost cell for x beyond the ends.
  std::size_t cell(S x) const {
    const Wide v = unit(x) * index(cdf.size());
    return v > 0 ? std::min(static_cast<std::size_t>(static_cast<std::int64_t>(static_cast<double>(v))), cdf.size() - 1)
                 : 0;
  }

 private:
  // A float has too few bits to count the cells of a large table, so float computes in double.
  using Wide = std::conditional_t<std::same_as<S, float>, double, S>;
  static Wide index(std::size_t i) { return Wide(static_cast<double>(static_cast<std::int64_t>(i))); }
  Wide within(S u, std::size_t i) const { return (Wide(u) - Wide(cdf.cdf(i))) / Wide(cdf.pmf(i)); }
  Wide unit(S x) const { return (Wide(x) - Wide(interval.lo)) / (Wide(interval.hi) - Wide(interval.lo)); }

  // Moves x back into cell i. Rounding may have moved it into a neighbouring cell, which may have weight 0.
  S nudged(S x, std::size_t i) const {
    using std::abs, std::clamp, std::nextafter;
    const S lo = S(interval.lo), hi = S(interval.hi);
    // First steps to the next number. If the distance from lo cannot resolve this step, uses the smallest step that it
    // can resolve.
    const S step = std::numeric_limits<S>::epsilon() * std::max(S(abs(lo)), S(abs(x)));
    for (int k = 0; k < 6; ++k) {
      const std::size_t at = cell(x);
      if (at == i) break;
      const S far = at < i ? S(x + step) : S(x - step);
      x = clamp(k < 2 ? S(nextafter(x, far)) : far, lo, hi);
    }
    return x;
  }
};

/// n cells of equal width on [lo, hi]. A cell is chosen with probability proportional to its weight; points are uniform
/// within. Models DiscreteDistribution (by index) and InvertibleWarp (by point).
///   sample : selects the cell i with cdf(i) <= u < cdf(i+1), then maps its interval linearly to the cell. Points stay
///            in their cell if cells are at least 8 eps max(|lo|, |hi|) wide.
///   pdf    : pmf(i) n / (hi - lo) [1/length]; 0 outside and in cells of weight 0.
///   invert : |invert(sample(u)) - u| <= 4 eps + 4 pmf(i) ulp(max(|x|, |lo|)) n / (hi - lo). The second term is the
///            rounding of x in sample and invert, magnified in narrow cells.
///   reach  : an outcome less likely than the spacing of u (2^-24 float, 2^-53 double) needs a finer u to occur.
///   throws : Error for no weights, a weight that is not finite and >= 0, all weights 0, or an interval with a width
///            that does not pass is_valid_scale.
///   Source : inverse transform sampling; Cdf states the bounds.
template <Real S> class TableDist1D {
 public:
  using Scalar = S;
  using Domain = Interval<S>;

  /// A distribution over weights.size() cells of `interval`.
  explicit TableDist1D(std::span<const double> weights, Interval<S> interval = {})
      : cdf_(weights), interval_(interval) {
    require(
        is_valid_scale(S(interval.hi - interval.lo)),
        "TableDist1D: [{}, {}] is too narrow or too wide for the scalar: its width is denormal or next to the largest "
        "number",
        static_cast<double>(interval.lo), static_cast<double>(interval.hi));
  }

  /// Distribution with weights f(x) at the centres of n cells.
  template <class F> static TableDist1D from_function(F&& f, std::size_t n, Interval<S> interval = {}) {
    std::vector<double> weights(n);
    for (std::size_t i = 0; i < n; ++i)
      weights[i] =
          static_cast<double>(f(interval.from_unit(S((static_cast<double>(i) + 0.5) / static_cast<double>(n)))));
    return TableDist1D(weights, interval);
  }

  DiscreteSample<S> sample_index(S u) const {
    const std::size_t i = view().find(u);
    return {i, pmf(i), view().remapped(u, i)};
  }
  S pmf(std::size_t i) const { return S(cdf_.pmf(i)); }
  std::size_t size() const { return cdf_.size(); }

  Domain domain() const { return interval_; }
  S sample(S u) const { return view().point(u, view().find(u)); }
  S pdf(S x) const { return interval_.contains(x) ? view().density(cell(x)) : S(0); }
  S invert(S x) const { return view().invert(x); }
  /// Cell that contains x; the outermost cell for x beyond the ends.
  std::size_t cell(S x) const { return view().cell(x); }
  /// Places where the density may jump, in coordinates of the chart.
  std::array<std::vector<double>, 1> breaks() const { return {even_breaks(size())}; }
  template <Real T> TableDist1D<T> cast() const { return TableDist1D<T>(cdf_, interval_.template cast<T>()); }

  /// The cumulative table.
  const Cdf& cdf() const { return cdf_; }

 private:
  template <Real T> friend class TableDist1D;
  TableDist1D(Cdf cdf, Interval<S> interval) : cdf_(std::move(cdf)), interval_(interval) {}
  PiecewiseConstantView<S> view() const { return {cdf_.view(), interval_}; }

  Cdf cdf_;
  Interval<S> interval_;
};

} // namespace mc
