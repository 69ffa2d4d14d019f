#pragma once
/// The Henyey-Greenstein phase function.

#include <mc/core/error.h>
#include <mc/core/turns.h>
#include <mc/domain/sphere.h>
#include <mc/warp/concept.h>

namespace mc {

/// Directions about +z with mean cosine g.
///   made from : g, or 1 - |g| and the sign. A rounded g near 1 has lost most digits of 1 - |g|.
///   sample    : t = 1 - cos = 2 u (1-g)^2 (1 + g (1-u)) / (1 - g + 2 g (1-u))^2 for g >= 0; mirrored for g < 0. The
///               formula has products and positive sums only, and no division by g, so g = 0 is no special case.
///   pdf       : (1 - g^2) / (4 pi ((1-g)^2 + 2 g t)^(3/2)) [1/sr], relative error 16 eps. t is computed from x^2 + y^2
///               near the pole.
///   invert    : |invert(sample(u)) - u| <= 16 eps for |g| <= 0.9, and 16 eps / (1 - |g|) beyond: there few bits of t
///               must hold the u of the backward half.
///   throws    : Error unless |g| < 1 and (1 - |g|)^2 >= min / eps of the scalar; for float this is 1 - |g| >= 3.2e-16.
///   Source    : [HenyeyGreenstein41].
template <Real S> class HenyeyGreenstein {
 public:
  using Scalar = S;
  using Domain = Sphere<S>;

  /// The distribution with mean cosine g.
  explicit HenyeyGreenstein(S g) : HenyeyGreenstein(g < 0 ? S(1 + g) : S(1 - g), g < 0) {
    require(g > -1 && g < 1, "HenyeyGreenstein: g = {} must lie in (-1, 1)", static_cast<double>(g));
  }
  /// The distribution with 1 - |g| = h and g < 0 if `backward`.
  static HenyeyGreenstein from_one_minus_abs_g(S h, bool backward = false) {
    require(h > 0 && h * h >= std::numeric_limits<S>::min() / std::numeric_limits<S>::epsilon() && h <= 1,
            "HenyeyGreenstein: 1 - |g| = {} must lie in (0, 1], and its square must not be denormal",
            static_cast<double>(h));
    return HenyeyGreenstein(h, backward);
  }

  Domain domain() const { return {}; }

  Vec3<S> sample(const Vec2<S>& u) const {
    using std::sqrt;
    const S v = 1 - u[0], q = 1 / (h_ + 2 * g_ * v);
    const S near = 2 * u[0] * sqr<S>(h_ * q) * (1 + g_ * v);    // 1 - cos
    const S far = 2 * v * sqr<S>((1 + g_) * q) * (h_ + g_ * v); // 1 + cos
    const S cosine = choose<S>(near < 1, 1 - near, far - 1);
    return polar_direction<S>(S(sqrt(S(near * far))), front_ * cosine, u[1]);
  }
  S pdf(const Vec3<S>& w) const {
    using std::sqrt;
    const S d = h_ * h_ + 2 * g_ * from_pole(w);
    return scale_ / d / S(sqrt(d)); // d^(3/2) itself may underflow
  }
  Vec2<S> invert(const Vec3<S>& w) const {
    using std::sqrt;
    const S t = from_pole(w), q = sqrt(S(h_ * h_ + 2 * g_ * t));
    return {clamp_to_unit<S>((1 + g_) * t / (q * (q + h_))), azimuth_turns<S>(w.x(), w.y())};
  }
  /// 1 - |g|.
  S one_minus_abs_g() const { return h_; }
  template <Real T> HenyeyGreenstein<T> cast() const { return HenyeyGreenstein<T>(T(h_), front_ < 0); }

 private:
  template <Real T> friend class HenyeyGreenstein;
  HenyeyGreenstein(S h, bool backward)
      : h_(h), g_(1 - h), front_(backward ? S(-1) : S(1)), scale_(h * (1 + g_) / (4 * pi<S>)) {}

  S from_pole(const Vec3<S>& w) const { return one_minus_z<S>({w.x(), w.y(), front_ * w.z()}); }

  S h_, g_, front_, scale_; ///< 1 - |g|, |g|, sign of g, (1 - g^2) / (4 pi)
};

} // namespace mc
