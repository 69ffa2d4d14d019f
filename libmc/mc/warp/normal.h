#pragma once
/// The normal distribution.

#include <mc/core/erf.h>
#include <mc/core/probit.h>
#include <mc/domain/interval.h>
#include <mc/warp/concept.h>

namespace mc {

/// Normal distribution on the real line by its inverse CDF, which maps strata of u to strata of x.
///   sample : x = mean + sigma probit(u). u = 0 is replaced by half a step of u, so x is finite. By rounding, x may
///            exceed the x of the next u by up to 4 eps |x|, for mean = 0.
///   pdf    : exp(-t^2 / 2) / (sigma sqrt(2 pi)) [1/length], t = (x - mean) / sigma. Relative error (2 + t^2) eps: the
///            tail is ill-conditioned in x.
///   invert : |invert(sample(u)) - u| <= 16 eps for mean = 0.
///   throws : Error unless mean is finite and sigma passes is_valid_scale.
///   Source : probit() of [Wichura88]; erfc from Boost.Math.
template <Real S> struct Normal {
  using Scalar = S;
  using Domain = RealLine<S>;

  S mean = 0,    ///< Mean.
      sigma = 1; ///< Standard deviation.

  Normal() = default;
  /// A distribution with the given mean and standard deviation.
  Normal(S mean_, S sigma_) : mean(mean_), sigma(sigma_) {
    using std::isfinite;
    require(isfinite(mean) && is_valid_scale(sigma, mean),
            "Normal: mean {}, sigma {}: both must be finite, sigma > 0 and neither denormal, next to the largest "
            "number nor "
            "below 8 eps |mean|",
            static_cast<double>(mean), static_cast<double>(sigma));
  }

  Domain domain() const { return {mean, sigma}; }
  S sample(S u) const { return mean + sigma * probit(u); }
  /// sample() of many numbers, with the same bits.
  void sample_n(std::span<const S> u, std::span<S> x) const {
    probits(u, x);
    for (S& each : x) each = mean + sigma * each;
  }
  S pdf(S x) const {
    using std::exp, std::sqrt;
    const S t = (x - mean) / sigma;
    return S(exp(S(-t * t / 2))) / (sigma * S(sqrt(S(2 * pi<S>))));
  }
  S invert(S x) const {
    using std::sqrt;
    return clamp_to_unit<S>(S(erfc(S((mean - x) / (sigma * S(sqrt(S(2))))))) / 2);
  }
  template <Real T> Normal<T> cast() const { return {T(mean), T(sigma)}; }
};

} // namespace mc
