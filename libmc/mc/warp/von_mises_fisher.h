#pragma once
/// The von Mises-Fisher distribution.

#include <mc/core/error.h>
#include <mc/core/turns.h>
#include <mc/domain/sphere.h>
#include <mc/warp/concept.h>

namespace mc {

/// Directions about +z with density proportional to exp(kappa cos(theta)).
///   sample : t = 1 - z = -log(1 - u (1 - exp(-2 kappa))) / kappa by log1p and expm1. For z < 0, or u > 1/2 at small
///            kappa, 1 + z is computed instead.
///   pdf    : kappa exp(-kappa t) / (2 pi (1 - exp(-2 kappa))) [1/sr]. t is computed from x^2 + y^2 near the pole.
///            Relative error (8 + 4 kappa t) eps: the tail is ill-conditioned in w. 63 % of the samples have kappa t <
///            1.
///   invert : |invert(sample(u)) - u| <= 16 eps.
///   throws : Error unless 0 <= kappa <= max eps of the scalar.
///   Source : [Jakob12], written in 1 - z. kappa = 0 is the uniform sphere.
template <Real S> class VonMisesFisher {
 public:
  using Scalar = S;
  using Domain = Sphere<S>;

  /// A distribution with concentration kappa.
  explicit VonMisesFisher(S kappa) : kappa_(kappa) {
    using std::exp, std::expm1, std::isfinite, std::max;
    using Limits = std::numeric_limits<S>;
    require(isfinite(kappa) && kappa >= 0 && kappa <= Limits::max() * Limits::epsilon(),
            "VonMisesFisher: kappa = {} must be finite and >= 0, and not next to the largest number",
            static_cast<double>(kappa));
    mass_ = kappa > Limits::epsilon() / 8 ? S(-S(expm1(S(-2 * kappa)))) : S(0); // 0: uniform to rounding
    tail_ = S(exp(S(-2 * kappa)));
    peak_ = mass_ > 0 ? S(kappa / (2 * pi<S> * mass_)) : S(1 / (4 * pi<S>));
    if (kappa > 20) return; // no u reaches the far pole
    growth_ = S(expm1(S(2 * kappa)));
    far_ = max(S(1 - S(exp(S(-kappa)))), S(0.5));
  }

  Domain domain() const { return {}; }

  Vec3<S> sample(const Vec2<S>& u) const {
    using std::log, std::log1p, std::min, std::sqrt;
    S t, cosine;
    if (!(mass_ > 0)) {
      t = 2 * u[0];
      cosine = 1 - t;
    } else if (u[0] < S(0.5)) {
      t = -S(log1p(S(-u[0] * mass_))) / kappa_;
      cosine = 1 - t;
    } else if (u[0] >= far_) {
      t = min(S(S(log1p(S((1 - u[0]) * growth_))) / kappa_), S(2)); // 1 + z; t (2 - t) is the same
      cosine = t - 1;
    } else {
      t = min(S(-S(log(S((1 - u[0]) + u[0] * tail_))) / kappa_), S(2));
      cosine = 1 - t;
    }
    return polar_direction<S>(S(sqrt(S(t * (2 - t)))), cosine, u[1]);
  }
  S pdf(const Vec3<S>& w) const {
    using std::exp;
    return peak_ * S(exp(S(-kappa_ * one_minus_z(w))));
  }
  Vec2<S> invert(const Vec3<S>& w) const {
    using std::expm1;
    const S t = one_minus_z(w);
    const S u = mass_ > 0 ? S(-S(expm1(S(-kappa_ * t))) / mass_) : S(t / 2);
    return {clamp_to_unit(u), azimuth_turns<S>(w.x(), w.y())};
  }
  /// Concentration.
  S kappa() const { return kappa_; }
  template <Real T> VonMisesFisher<T> cast() const { return VonMisesFisher<T>(T(kappa_)); }

 private:
  S kappa_, mass_, tail_, peak_; ///< 1 - exp(-2k), exp(-2k), pdf at the pole
  S growth_ = 0, far_ = 1;       ///< exp(2k) - 1 and the least u for z < 0; set for kappa <= 20 only
};

} // namespace mc
