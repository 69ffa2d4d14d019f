#pragma once
/// The power-cosine lobe.

#include <mc/core/error.h>
#include <mc/core/turns.h>
#include <mc/domain/hemisphere.h>
#include <mc/warp/concept.h>

#include <algorithm>

namespace mc {

/// Directions with density proportional to cos(theta)^n for real n.
///   sample : 1 - z = 1 - (1 - u0)^(1 / (n + 1)) by expm1 and log1p, phi = 2 pi u1.
///   pdf    : (n + 1) / (2 pi) (1 - t)^n [1/sr]; 0 below the horizon. t = 1 - z is computed from x^2 + y^2 near the
///            pole. Relative error (8 + 4 n t) eps: the tail is ill-conditioned in w.
///   invert : |invert(sample(u)) - u| <= 16 eps for n >= 1, where 1 - u0 = z^(n + 1).
///   throws : Error unless n is finite and >= 0.
///   Source : [Blinn77].
template <Real S> class BlinnPhong {
 public:
  using Scalar = S;
  using Domain = Hemisphere<S>;

  /// A lobe with exponent n.
  explicit BlinnPhong(S n) : n_(n) {
    using std::isfinite;
    require(isfinite(n) && n >= 0, "BlinnPhong: exponent {} must be finite and >= 0", static_cast<double>(n));
  }

  Domain domain() const { return {}; }
  Vec3<S> sample(const Vec2<S>& u) const {
    using std::exp, std::expm1, std::log1p, std::sqrt;
    const S log_cosine = S(log1p(S(-u[0]))) / (n_ + 1), t = -S(expm1(log_cosine));
    return polar_direction<S>(S(sqrt(S(t * (2 - t)))), t < S(0.5) ? S(1 - t) : S(exp(log_cosine)), u[1]);
  }
  S pdf(const Vec3<S>& w) const {
    using std::exp;
    return w.z() > 0 ? S((n_ + 1) / (2 * pi<S>)*S(exp(S(n_ * log_z(w))))) : S(0);
  }
  Vec2<S> invert(const Vec3<S>& w) const {
    using std::expm1;
    const S u = w.z() > 0 ? S(-S(expm1(S((n_ + 1) * log_z(w))))) : S(1);
    return {clamp_to_unit(u), azimuth_turns<S>(w.x(), w.y())};
  }
  template <Real T> BlinnPhong<T> cast() const { return BlinnPhong<T>(T(n_)); }

 private:
  static S log_z(const Vec3<S>& w) {
    using std::log, std::log1p;
    return w.z() > S(0.5) ? S(log1p(S(-one_minus_z(w)))) : S(log(w.z()));
  }
  S n_;
};

} // namespace mc
