#pragma once
/// The 2-D Gaussian in polar form.

#include <mc/core/turns.h>
#include <mc/domain/product.h>
#include <mc/warp/concept.h>

namespace mc {

/// Isotropic normal distribution about the origin of the plane.
///   sample : r = sigma sqrt(-2 log(1 - u0)), phi = 2 pi u1. 1 - u0 is never 0, so r is finite for every u.
///   pdf    : exp(-r^2 / (2 sigma^2)) / (2 pi sigma^2) [1/area]. Relative error (4 + (r / sigma)^2) eps.
///   invert : |invert(sample(u)) - u| <= 8 eps.
///   throws : Error unless sigma > 0 and sigma^2 passes is_valid_scale.
///   Source : [BoxMuller58]. Two independent normals by inverse CDF (Normal2D) distort strata less and cost more.
template <Real S> struct IsotropicNormal {
  using Scalar = S;
  using Domain = Plane<S>;

  S sigma = 1; ///< Standard deviation of each coordinate.

  IsotropicNormal() = default;
  /// A distribution with standard deviation sigma in each coordinate.
  explicit IsotropicNormal(S sigma_) : sigma(sigma_) {
    require(
        sigma > 0 && is_valid_scale(S(sigma * sigma)),
        "IsotropicNormal: sigma {} must be finite and > 0, its square neither denormal nor next to the largest number",
        static_cast<double>(sigma));
  }

  Domain domain() const { return {{S(0), sigma}, {S(0), sigma}}; }
  Vec2<S> sample(const Vec2<S>& u) const {
    using std::sqrt;
    return polar_point<S>(sigma * S(sqrt(S(-2 * log_one_minus(u[0])))), u[1]);
  }
  S pdf(const Vec2<S>& p) const {
    using std::exp;
    return S(exp(S(-half_square(p)))) / (2 * pi<S> * sigma * sigma);
  }
  Vec2<S> invert(const Vec2<S>& p) const {
    using std::expm1;
    return {clamp_to_unit<S>(-S(expm1(S(-half_square(p))))), azimuth_turns<S>(p.x(), p.y())};
  }
  template <Real T> IsotropicNormal<T> cast() const { return IsotropicNormal<T>(T(sigma)); }

 private:
  // log(1 - u), accurate for small u too: a factor undoes the rounding of 1 - u. Faster than log1p.
  static S log_one_minus(const S& u) {
    using std::log;
    const S w = 1 - u, rounded = 1 - w;
    return rounded == 0 ? S(-u) : S(S(log(w)) * (u / rounded));
  }
  S half_square(const Vec2<S>& p) const { return (sqr<S>(p.x() / sigma) + sqr<S>(p.y() / sigma)) / 2; }
};

} // namespace mc
