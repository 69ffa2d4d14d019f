#pragma once
/// Subjects from generators with the interface of the standard library: d(engine) returns a number.

#include <mc/check/subject/make_distribution.h>
#include <mc/random/pcg.h>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

namespace mc {

/// A random engine for generators of the standard library, with 64 bits of a Pcg stream for each call.
class RandomEngine {
 public:
  using result_type = std::uint64_t;                                                     ///< type of the bits
  explicit RandomEngine(std::uint64_t seed) : random_(seed) {}                           ///< starts stream 0 of `seed`
  static constexpr result_type min() { return 0; }                                       ///< smallest result
  static constexpr result_type max() { return std::numeric_limits<result_type>::max(); } ///< largest result
  result_type operator()() { return random_.next64(); }                                  ///< the next 64 bits

 private:
  Pcg random_;
};

/// A copyable object d with d(engine), a number. Members min() and max() bound the results, as in the standard library.
template <class D>
concept Generator = std::copy_constructible<D> && requires(D d, RandomEngine& engine) {
  requires std::is_arithmetic_v<std::remove_cvref_t<decltype(d(engine))>>;
};

/// Marks a function as a cumulative distribution function, P(X <= x).
template <class F> struct ClaimedCdf {
  F f; ///< takes a double
  /// Marks f.
  explicit ClaimedCdf(F f_) : f(std::move(f_)) {}
};

namespace detail {

template <class T> inline constexpr bool is_cdf = false;
template <class F> inline constexpr bool is_cdf<ClaimedCdf<F>> = true;

/// Draws the numbers of one stream, with one generator, so that numbers that it keeps for the next call count too.
using DrawNumbers = std::function<std::vector<double>(std::uint64_t seed, std::size_t n)>;

/// A generator as functions of numbers.
struct AnyGenerator {
  std::string name;
  DrawNumbers draw;
  double lo, hi;         ///< bounds of the results; may be infinite
  bool is_float = false; ///< the results are of type float
};

/// Returns the subject of a density, of probabilities of integers, or of a cumulative distribution function.
Subject subject_of_pdf(const AnyGenerator& generator, const std::function<double(double x)>& pdf);
Subject subject_of_pmf(const AnyGenerator& generator, const std::function<double(double k)>& pmf);
Subject subject_of_cdf(const AnyGenerator& generator, std::function<double(double x)> cdf);

template <Generator D> AnyGenerator any_generator(std::string name, const D& d) {
  using Result = std::remove_cvref_t<decltype(std::declval<D&>()(std::declval<RandomEngine&>()))>;
  AnyGenerator g{std::move(name), {}, -HUGE_VAL, HUGE_VAL, std::same_as<Result, float>};
  if constexpr (requires {
                  d.min();
                  d.max();
                }) {
    const auto lo = d.min(), hi = d.max();
    if (lo > std::numeric_limits<decltype(lo)>::lowest()) g.lo = static_cast<double>(lo);
    if (hi < std::numeric_limits<decltype(hi)>::max()) g.hi = static_cast<double>(hi);
  }
  g.draw = [d](std::uint64_t seed, std::size_t n) {
    D generator = d;
    RandomEngine engine(seed);
    std::vector<double> x(n);
    for (double& one : x) one = static_cast<double>(generator(engine));
    return x;
  };
  return g;
}

} // namespace detail

/// Returns the subject of a generator with its claimed law.
///   law : for floating-point results the density, or ClaimedCdf(f), whose values at the samples must be uniform. For
///         integers the probability of k. If a bound of the integers is infinite, or there are more than 2^20, all
///         outcomes beyond the extremes of 65536 pilot samples are one outcome with the rest of the probability.
///   throws : Error if a probability is not in [0, 1], when it is checked.
template <Generator D, class Law> Subject make_generator_subject(std::string name, const D& d, Law law) {
  using Result = std::remove_cvref_t<decltype(std::declval<D&>()(std::declval<RandomEngine&>()))>;
  const detail::AnyGenerator g = detail::any_generator(std::move(name), d);
  if constexpr (detail::is_cdf<Law>) {
    static_assert(std::floating_point<Result>, "a generator of integers needs the probability of k, not a cdf");
    return subject_of_cdf(g, [f = law.f](double x) { return static_cast<double>(f(x)); });
  } else if constexpr (std::floating_point<Result>) {
    return subject_of_pdf(g, [law](double x) { return static_cast<double>(law(x)); });
  } else {
    return subject_of_pmf(g, [law](double k) { return static_cast<double>(law(static_cast<Result>(k))); });
  }
}

} // namespace mc
