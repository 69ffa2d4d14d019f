#pragma once
/// The probit function, the inverse of the normal distribution function.

#include <mc/core/log.h>

#include <array>
#include <span>

namespace mc {

namespace detail {

// c[I] + c[I + 2] y + c[I + 4] y^2 + ...; a recursion, since compilers unroll loops too late to vectorize a loop around
// them.
template <std::size_t I, class S, std::size_t N> constexpr S every_second(const std::array<S, N>& c, S y) {
  if constexpr (I + 2 >= N) return c[I];
  else return c[I] + y * every_second<I + 2>(c, y);
}
// c[0] + c[1] x + ... as an even and an odd part, which processors compute at the same time.
template <class S, std::size_t N> constexpr S polynomial(const std::array<S, N>& c, S x) {
  return every_second<0>(c, x * x) + x * every_second<1>(c, x * x);
}

/// Rational approximations of x = probit(u), fitted to the least largest relative error, in the form of [Wichura88].
///   centre : x / q in centre_edge^2 - q^2, for |q| <= centre_edge with q = u - 1/2; error 8e-17 and 5e-8.
///   tail   : -x in sqrt(-log u) - tail_start, for u from least_tail to 1/2 - centre_edge; error 9e-18 and 6e-9.
template <std::floating_point S> struct ProbitFit;
template <> struct ProbitFit<double> {
  static constexpr std::array centre_top = {3.3871328727963665983, 133.15488503199009552, 1972.0228192222932681,
                                            13736.695520145012286, 45946.758725738663344, 67316.30837732389691,
                                            33464.003429289455154, 2512.3043233865865201};
  static constexpr std::array centre_bottom = {1.0,
                                               42.317232863311738379,
                                               687.32623728886274254,
                                               5396.0050617138468347,
                                               21224.29584016156022,
                                               39334.8470186465314,
                                               28755.210042064158465,
                                               5232.581708396253563};
  static constexpr std::array tail_top = {
      1.466054773701372521,    4.670189771664565629,     5.7399878365330007377,
      3.6269708598395969086,   1.2978820952534654768,    0.26866441155922764064,
      0.030887547479187771246, 0.0017263336912313572906, 0.000032972507849419395136};
  static constexpr std::array tail_bottom = {1.0,
                                             2.0248161215090978707,
                                             1.6461442273225260651,
                                             0.69122716076925221977,
                                             0.1600908658101185838,
                                             0.019988326302902624607,
                                             0.001182951494446057369,
                                             0.000023314418184627162195};
};
template <> struct ProbitFit<float> {
  static constexpr std::array centre_top = {3.387132713f, 50.42659972f, 159.2321209f, 59.07141861f};
  static constexpr std::array centre_bottom = {1.0f, 17.89290358f, 78.73358754f, 67.15153453f};
  static constexpr std::array tail_top = {1.466054776f, 2.8991985f, 1.499359743f, 0.2211066836f, -3.848722572e-5f};
  static constexpr std::array tail_bottom = {1.0f, 0.8168183643f, 0.1557595117f};
};

template <std::floating_point S> inline constexpr S centre_edge = S(0.425);
template <std::floating_point S> inline constexpr S tail_start = S(1.625);
template <Real S> inline const S least_tail = std::numeric_limits<S>::epsilon() / 4;

template <std::floating_point S> S central_probit(S q) {
  using Fit = ProbitFit<S>;
  const S t = centre_edge<S> * centre_edge<S> - q * q;
  return q * polynomial(Fit::centre_top, t) / polynomial(Fit::centre_bottom, t);
}

// probit(u) in the lower tail.
template <std::floating_point S> S tail_probit(S u) {
  using Fit = ProbitFit<S>;
  const BinaryFraction<S> x(u < least_tail<S> ? least_tail<S> : u);
  const S r = std::sqrt(-log_of(x.k, x.f)) - tail_start<S>;
  return -polynomial(Fit::tail_top, r) / polynomial(Fit::tail_bottom, r);
}

} // namespace detail

/// The x up to which the standard normal distribution has the probability u, for u in [0, 1]. Probabilities below x or
/// above x that are less than eps / 4 count as eps / 4, so that x is finite.
///   error : relative error at most 4 eps.
template <Real S> S probit(const S& u) {
  if constexpr (std::floating_point<S>) {
    const S q = u - S(0.5);
    if (std::abs(q) <= detail::centre_edge<S>) return detail::central_probit(q);
    const S x = detail::tail_probit(q < 0 ? u : 1 - u);
    return q < 0 ? x : S(-x);
  } else {
    const S upper = 1 - u, tail = u < S(0.5) ? u : upper, least = detail::least_tail<S>;
    const S x = S(sqrt(S(2))) * S(erfc_inv(S(2 * (tail < least ? least : tail))));
    return u < S(0.5) ? S(-x) : x;
  }
}

/// probit() of many numbers, with the same bits, several at a time.
///   arrays : x may be u.
///   throws : Error unless both have the same size.
void probits(std::span<const float> u, std::span<float> x);
/// Same for double.
void probits(std::span<const double> u, std::span<double> x);

} // namespace mc
