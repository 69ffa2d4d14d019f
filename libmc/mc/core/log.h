#pragma once
/// Logarithms that compilers can inline and vectorize: without calls, tables or branches.

#include <mc/core/types.h>

#include <bit>
#include <concepts>
#include <type_traits>

namespace mc {

namespace detail {

template <std::floating_point S> struct LogParts; // of the format of S
template <> struct LogParts<double> {
  using Bits = std::uint64_t;
  static constexpr int mantissa_bits = 52;
  static constexpr Bits root_half = 0x3fe6a09e667f3bcd; ///< Bits of sqrt(1/2).
  static constexpr double ln2_high = 0x1.62e42feep-1,   ///< ln 2 = high + low; products of high and k are exact.
      ln2_low = 0x1.a39ef35793c76p-33;
  /// log((1 + s) / (1 - s)) = 2 s + s^3 R(s^2).
  static constexpr double series(double z) {
    return 0.66666666666667345169 +
           z * (0.39999999999413500387 +
                z * (0.2857142874275619738 +
                     z * (0.22222198525175018094 +
                          z * (0.18183567311219936379 + z * (0.15313962523329679277 + z * 0.14796939659391879221)))));
  }
};
template <> struct LogParts<float> {
  using Bits = std::uint32_t;
  static constexpr int mantissa_bits = 23;
  static constexpr Bits root_half = 0x3f3504f3;
  static constexpr float ln2_high = 0x1.62e4p-1f, ln2_low = 0x1.7f7d1cp-20f;
  static constexpr float series(float z) { return 0.6666677632f + z * (0.3997753973f + z * 0.2987199978f); }
};

// log(2^k (1 + f)) for sqrt(1/2) <= 1 + f <= sqrt(2).
template <std::floating_point S> S log_of(S k, S f) {
  using Parts = LogParts<S>;
  const S s = f / (2 + f), z = s * s, half = S(0.5) * f * f;
  // 2 s = f - s f, and s f = s f^2 / 2 + f^2 / 2 - ..., so that the rounding of s counts for little
  return k * Parts::ln2_high - ((half - (s * (half + z * Parts::series(z)) + k * Parts::ln2_low)) - f);
}

template <std::floating_point S> struct BinaryFraction {
  S k, f; ///< x = 2^k (1 + f).
  explicit BinaryFraction(S x) {
    using Parts = LogParts<S>;
    using Bits = typename Parts::Bits;
    const Bits bits = std::bit_cast<Bits>(x) - Parts::root_half;
    // The whole part of bits, with its sign, as a number: added to the bits of 3 * 2^(mantissa_bits - 1).
    constexpr S magic = S(Bits{3} << (Parts::mantissa_bits - 1));
    const Bits exponent = bits >> Parts::mantissa_bits;
    constexpr int width = 8 * sizeof(Bits) - Parts::mantissa_bits;
    constexpr Bits sign = Bits{1} << (width - 1);
    const Bits whole = (exponent ^ sign) - sign;
    k = std::bit_cast<S>(std::bit_cast<Bits>(magic) + whole) - magic;
    f = std::bit_cast<S>((bits & ((Bits{1} << Parts::mantissa_bits) - 1)) + Parts::root_half) - 1;
  }
};

} // namespace detail

/// log(1 - u) for u in [0, 1).
///   error : relative error at most 2 eps.
template <Real S> S log_of_complement(const S& u) {
  if constexpr (std::is_same_v<S, float> || std::is_same_v<S, double>) {
    const S rest = 1 - u;
    const detail::BinaryFraction<S> x(rest);
    constexpr S root_half = std::bit_cast<S>(detail::LogParts<S>::root_half);
    return detail::log_of(x.k, rest > root_half ? -u : x.f); // k = 0 there, and -u is without rounding
  } else {
    return S(log1p(S(-u)));
  }
}

} // namespace mc
