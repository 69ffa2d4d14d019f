#pragma once
/// Cosine, sine and azimuth of angles in full turns, which uniform numbers in [0,1) give directly.

#include <mc/core/types.h>

#include <array>
#include <cstdint>
#include <limits>

namespace mc {

/// Cosine and sine of one angle.
template <Real S> struct CosSin {
  S cos,   ///< Cosine.
      sin; ///< Sine.
};

/// Cosine and sine of t turns, |t| <= 1/8. Each is one polynomial without branch or call, so that loops vectorise.
///   error  : 2 ulp for float and for double.
///   Source : Interpolation in t^2 at Chebyshev nodes of (cos(2 pi t) - 1) / t^2 and sin(2 pi t) / t, with 2 pi as a
///            sum of two numbers.
template <Real S> CosSin<S> cos_sin_octant(const S& t) {
  const S z = t * t;
  if constexpr (std::same_as<S, float>) {
    return {1 + z * (-19.7392088f + z * (64.9393691f + z * (-85.4488201f + z * 59.424106f))),
            t * 6.28318548f + t * (-1.74845553e-7f + z * (-41.3416626f + z * (81.5925429f + z * -75.4016127f)))};
  } else if constexpr (std::same_as<S, double>) {
    return {1 + z * (-19.73920880217871723 +
                     z * (64.939394022668242743 +
                          z * (-85.456817206643804246 +
                               z * (60.244641352702008933 +
                                    z * (-26.426253275854721364 +
                                         z * (7.9032069115696784291 + z * -1.6990343940660636356)))))),
            t * 6.2831853071795862 +
                t * (2.4492935982947064e-16 +
                     z * (-41.341702240399636207 +
                          z * (81.605249275948035209 +
                               z * (-76.705859704274550647 +
                                    z * (42.058685020160894047 +
                                         z * (-15.093804209987113512 + z * 3.7808689593022955184))))))};
  } else {
    using std::cos, std::sin;
    const S phi = 2 * pi<S> * t;
    return {S(cos(phi)), S(sin(phi))};
  }
}

/// Cosine and sine of u turns, u in [0, 1]. Subtracts the nearest quarter turn, which is exact, whereas 2 pi u would be
/// rounded.
///   error  : 2 ulp for float and for double, also near the zeros.
template <Real S> CosSin<S> cos_sin(const S& u) {
  if constexpr (std::floating_point<S>) {
    const auto quarter = static_cast<std::int32_t>(4 * u + S(0.5));
    const CosSin<S> q = cos_sin_octant<S>(u - S(0.25) * static_cast<S>(quarter));
    // An odd quarter exchanges sine and cosine, and the quarter determines the signs. Bit operations avoid branches on
    // random numbers, which are mispredicted.
    using Bits = BitsOf<S>;
    const Bits k = static_cast<Bits>(quarter), c = std::bit_cast<Bits>(q.cos), s = std::bit_cast<Bits>(q.sin);
    const Bits exchange = (c ^ s) & (Bits{0} - (k & 1));
    constexpr int to_sign = 8 * sizeof(Bits) - 2;
    return {std::bit_cast<S>(c ^ exchange ^ ((k + 1) & 2) << to_sign),
            std::bit_cast<S>(s ^ exchange ^ (k & 2) << to_sign)};
  } else {
    return cos_sin_octant<S>(u);
  }
}

namespace detail {

/// atan(q) in turns, |q| <= 1/8.
template <std::floating_point S> S small_turn(S q) {
  const S z = q * q;
  if constexpr (std::same_as<S, float>)
    return q * 0.159154937f + q * (6.4206383e-9f + z * (-0.05305164563f + z * (0.0318286043f + z * -0.02232783611f)));
  else
    return q * 0.15915494309189534561 +
           q * (-9.839338338e-18 + z * (-0.053051647697298372904 +
                                        z * (0.031830988618045601838 +
                                             z * (-0.022736420192465473106 +
                                                  z * (0.017683814368816994572 + z * (-0.014460180724602972583 +
                                                                                      z * 0.011757918990522233569))))));
}

} // namespace detail

/// Azimuth of (x, y) in full turns, in [0,1). Returns 0 at the origin. Faster than atan2.
///   error  : 2 ulp for float and for double.
///   Source : atan t = atan c + atan((t - c) / (1 + c t)) with c the nearest of 0, 1/4, ... 1. The second argument is
///            at most 1/8. Its atan is interpolated in q^2 at Chebyshev nodes of (atan(q) / q - 1) / (2 pi q^2), with 1
///            / (2 pi) as a sum of two numbers.
template <Real S> S azimuth_turns(const S& x, const S& y) {
  using std::abs, std::atan2;
  if constexpr (std::floating_point<S>) {
    using Limits = std::numeric_limits<S>;
    const S a = abs(x), b = abs(y), hi = choose<S>(b > a, b, a);
    if (hi >= Limits::min() / Limits::epsilon() && hi <= Limits::max() / 4) {
      constexpr std::array<S, 5> turns{0, S(0.03898956518868466273), S(0.073791808825216637088),
                                       S(0.10241638234956672582), S(0.125)}; // atan of 0, 1/4, 1/2, 3/4, 1 in turns
      const S lo = choose<S>(b > a, a, b);
      const int nearest = (lo > S(0.125) * hi) + (lo > S(0.375) * hi) + (lo > S(0.625) * hi) + (lo > S(0.875) * hi);
      const S c = S(0.25) * static_cast<S>(nearest);
      S t = turns[static_cast<std::size_t>(nearest)] + detail::small_turn((lo - c * hi) / (hi + c * lo));
      t = choose<S>(b > a, S(0.25) - t, t);
      t = choose<S>(x < 0, S(0.5) - t, t);
      t = choose<S>(y < 0, 1 - t, t);
      return t >= 1 ? S(0) : t;
    }
  }
  if (x == 0 && y == 0) return S(0);
  // Denormal, huge and multiprecision numbers.
  const S t = S(atan2(y, x)) / (2 * pi<S>), wrapped = t < 0 ? S(t + 1) : t;
  return wrapped >= 1 ? S(0) : wrapped;
}

/// Point of the plane at radius r and azimuth u [turns].
template <Real S> Vec2<S> polar_point(const S& r, const S& u) {
  const CosSin<S> a = cos_sin<S>(u);
  return {r * a.cos, r * a.sin};
}

/// Direction with the given sine and cosine of the polar angle and azimuth u [turns].
template <Real S> Vec3<S> polar_direction(const S& sin_theta, const S& cos_theta, const S& u) {
  const CosSin<S> a = cos_sin<S>(u);
  return {sin_theta * a.cos, sin_theta * a.sin, cos_theta};
}

} // namespace mc
