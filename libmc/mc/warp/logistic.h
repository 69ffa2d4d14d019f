#pragma once
/// Logistic distributions on the line and on an interval.

#include <mc/domain/interval.h>
#include <mc/warp/concept.h>

#include <algorithm>

namespace mc {

namespace detail {

/// 1 / (1 + e^-t), with relative precision in the lower tail.
template <Real S> S sigmoid(const S& t) {
  using std::exp;
  if (t < 0) {
    const S e = S(exp(t));
    return e / (1 + e);
  }
  return 1 / (1 + S(exp(S(-t))));
}

/// e^-t / (1 + e^-t)^2. Even in t.
template <Real S> S logistic_density(const S& t) {
  using std::abs, std::exp;
  const S e = S(exp(S(-S(abs(t)))));
  return e / sqr<S>(1 + e);
}

} // namespace detail

/// Logistic distribution on the real line.
///   sample : x = mean + scale log(u / (1 - u)). u = 0 is replaced by half a step of u, so x is finite.
///   pdf    : e^-t / (scale (1 + e^-t)^2) [1/length], t = (x - mean) / scale. Relative error (4 + |t|) eps for mean =
///            0.
///   invert : |invert(sample(u)) - u| <= 8 eps for mean = 0. A mean far from 0 adds the rounding of x.
///   throws : Error unless mean is finite and scale passes is_valid_scale.
template <Real S> struct Logistic {
  using Scalar = S;
  using Domain = RealLine<S>;

  S mean = 0,    ///< Mean.
      scale = 1; ///< Scale; the standard deviation is pi / sqrt(3) times the scale.

  Logistic() = default;
  /// A distribution with the given mean and scale.
  Logistic(S mean_, S scale_) : mean(mean_), scale(scale_) {
    using std::isfinite;
    require(isfinite(mean) && is_valid_scale(scale, mean),
            "Logistic: mean {}, scale {}: both must be finite, scale > 0 and neither denormal, next to the largest "
            "number nor "
            "below 8 eps |mean|",
            static_cast<double>(mean), static_cast<double>(scale));
  }

  Domain domain() const { return {mean, scale}; }
  S sample(S u) const {
    using std::log, std::log1p, std::max;
    // Between the quartiles 2 u - 1 is exact, so x keeps its relative precision where it crosses the mean.
    if (u > S(0.25) && u < S(0.75)) return mean + scale * S(log1p(S((2 * u - 1) / (1 - u))));
    const S v = max(u, S(std::numeric_limits<S>::epsilon() / 4));
    return mean + scale * S(log(S(v / (1 - v))));
  }
  S pdf(S x) const { return detail::logistic_density<S>((x - mean) / scale) / scale; }
  S invert(S x) const { return clamp_to_unit(detail::sigmoid<S>((x - mean) / scale)); }
  template <Real T> Logistic<T> cast() const { return {T(mean), T(scale)}; }
};

/// Logistic distribution of mean 0 cut to [lo, hi].
///   sample : x = scale log(F / G), where F = F(lo) + u m and G = F(-hi) + (1 - u) m belong to the logistic CDF. The
///            mass of the interval is m = F(hi) F(-lo) (1 - e^((lo - hi) / scale)), which does not cancel in the tails.
///   pdf    : logistic density / m [1/length]; 0 outside. Relative error (8 + 2 d) eps. d is the distance in units of
///            scale from the end nearest to 0, or from 0 if the interval contains it.
///   invert : |invert(sample(u)) - u| <= 8 eps max(1, max(|lo|, |hi|) / min(scale, hi - lo)). The rounding of x causes
///            this bound.
///   throws : Error unless lo < hi, both are finite, scale and hi - lo pass is_valid_scale, and m does not underflow.
/// Intervals in a tail, or shorter than scale, use another form. There the distance from the inner end is scale log(1 +
/// odds). The odds compare the mass between the end and x with the rest of the tail. All terms are relative to the end,
/// so the tail may be as thin as S can represent.
template <Real S> struct TrimmedLogistic {
  using Scalar = S;
  using Domain = Interval<S>;

  S scale, ///< Scale. Read only, like lo and hi: the constructor derives further constants from them.
      lo,  ///< Lower end.
      hi;  ///< Upper end.

  TrimmedLogistic() : TrimmedLogistic(1, -1, 1) {}
  /// A distribution on [lo, hi] with the given scale.
  TrimmedLogistic(S scale_, S lo_, S hi_) : scale(scale_), lo(lo_), hi(hi_) {
    using std::exp, std::expm1, std::isfinite;
    require(is_valid_scale(scale),
            "TrimmedLogistic: scale {} must be finite and > 0, neither denormal nor next to the largest",
            static_cast<double>(scale));
    require(
        isfinite(lo) && isfinite(hi) && lo < hi && is_valid_scale(S(hi - lo)),
        "TrimmedLogistic: [{}, {}] needs finite bounds with lo < hi, neither denormally close nor next to the largest",
        static_cast<double>(lo), static_cast<double>(hi));
    const S length = (hi - lo) / scale, decay = S(exp(S(-length))), share = -S(expm1(S(-length)));
    mass_ = detail::sigmoid<S>(hi / scale) * detail::sigmoid<S>(-lo / scale) * share;
    require(mass_ >= std::numeric_limits<S>::min(), "TrimmedLogistic: the mass of [{}, {}] at scale {} underflows",
            static_cast<double>(lo), static_cast<double>(hi), static_cast<double>(scale));
    low_ = detail::sigmoid<S>(lo / scale);
    high_ = detail::sigmoid<S>(-hi / scale);
    if (is_wide()) return;
    const S outer = inner() / scale + length, top = detail::sigmoid<S>(outer);
    mass_ = share * top;
    low_ = detail::sigmoid<S>(-outer) + top * decay;
    high_ = 1 + S(exp(S(-inner() / scale)));
  }

  Domain domain() const { return {lo, hi}; }
  S sample(S u) const {
    using std::log, std::log1p, std::max, std::min;
    const S v = max(u, S(std::numeric_limits<S>::epsilon() / 4)), w = 1 - v;
    if (is_wide()) return min(max(S(scale * S(log(S((low_ + v * mass_) / (high_ + w * mass_))))), lo), hi);
    if (hi > 0) return min(S(lo + scale * S(log1p(S(v * mass_ * high_ / (low_ + w * mass_))))), hi);
    return max(S(hi - scale * S(log1p(S(w * mass_ * high_ / (low_ + v * mass_))))), lo);
  }
  S pdf(S x) const {
    using std::exp;
    if (!(x >= lo && x <= hi)) return S(0);
    if (is_wide()) return detail::logistic_density<S>(x / scale) / mass_ / scale;
    const S at = hi > 0 ? x : S(-x);
    return S(exp(S((inner() - at) / scale))) * high_ / (sqr<S>(1 + S(exp(S(-at / scale)))) * mass_) / scale;
  }
  S invert(S x) const {
    using std::exp, std::expm1;
    const S up_to = hi > 0 ? S(detail::sigmoid<S>(x / scale) / detail::sigmoid<S>(hi / scale))
                           : S(S(exp(S((x - hi) / scale))) * (1 + S(exp(S(hi / scale)))) / (1 + S(exp(S(x / scale)))));
    return clamp_to_unit<S>(up_to * (S(expm1(S((lo - x) / scale))) / S(expm1(S((lo - hi) / scale)))));
  }
  template <Real T> TrimmedLogistic<T> cast() const { return {T(scale), T(lo), T(hi)}; }

 private:
  // Whether the interval contains 0 in its interior and is longer than scale.
  bool is_wide() const { return lo < 0 && hi > 0 && hi - lo > scale; }
  // The reference end of an interval that is not wide; mirrored for an interval below 0.
  S inner() const { return hi > 0 ? lo : S(-hi); }

  // Wide intervals: m, F(lo), F(-hi). Other intervals: the share of the tail beyond the inner end that the interval
  // contains, the rest of this tail, and 1 / F(inner end). The share v of the interval ends at odds v mass_ high_ /
  // (low_ + (1 - v) mass_).
  S mass_, low_, high_;
};

} // namespace mc
