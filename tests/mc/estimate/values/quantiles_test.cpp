#include <mc/core/error.h>
#include <mc/estimate/values/quantiles.h>
#include <mc/random/uniform.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

namespace {

using Unit = std::span<const double>;

// Functions with a known distribution: a random increasing function g of a number that is uniform in [0,1).
struct Known {
  std::size_t dim;
  int kind;
  double a, b;

  explicit Known(std::uint64_t seed)
      : dim(1 + seed % 4), kind(static_cast<int>(seed / 4 % 3)), a(0.2 + 3 * mc::hash_uniform<double>(seed, 1)),
        b(20 * (mc::hash_uniform<double>(seed, 2) - 0.5)) {}
  double g(double v) const { return b + 10 * std::pow(v, a); }
  double operator()(Unit u) const {
    double largest = 0, turned = 0, product = 1;
    for (std::size_t d = 0; d < dim; ++d) {
      largest = std::max(largest, u[d]);
      turned += static_cast<double>(d + 1) * u[d];
      product *= u[d];
    }
    if (kind == 0) return g(std::pow(largest, static_cast<double>(dim))); // max^d is uniform
    if (kind == 1) return g(turned - std::floor(turned));
    double share = 0, term = 1; // for the product, P(u1 ... ud <= p) = p (1 + l + l^2 / 2 + ...) with l = -log p
    for (std::size_t d = 0; d < dim; ++d) {
      share += term;
      term *= -std::log(product) / static_cast<double>(d + 1);
    }
    return g(product * share);
  }
};

// 300 functions with three quantiles each. The binomial deviation is .0073, larger because quantiles of one function
// are dependent. The required coverage is .95; alpha < 1 % for either bound.
TEST(Quantiles, IntervalsCover) {
  constexpr std::array p = {0.05, 0.5, 0.9};
  for (const std::uint64_t calls : {500u, 6000u}) {
    int covered = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      const Known f(seed);
      const auto found = mc::quantiles(f, static_cast<int>(f.dim), p, {.calls = calls, .seed = seed, .threads = 1});
      for (std::size_t i = 0; i < p.size(); ++i) {
        ASSERT_LE(found[i].interval.lo, found[i].value);
        ASSERT_LE(found[i].value, found[i].interval.hi);
        covered += found[i].interval.lo <= f.g(p[i]) && f.g(p[i]) <= found[i].interval.hi;
      }
    }
    EXPECT_GE(covered / 900.0, 0.93) << calls;
    EXPECT_LE(covered / 900.0, 0.98) << calls;
  }
}

TEST(Quantiles, OfFewValues) {
  const auto die = [](Unit u) { return std::floor(6 * u[0]) + 1; };
  const auto found = mc::quantiles(die, 1, std::array{0.1, 0.5, 0.51, 0.99}, {.calls = 10'000});
  EXPECT_EQ(found[0].value, 1);
  EXPECT_EQ(found[0].interval.lo, 1);
  EXPECT_EQ(found[0].interval.hi, 1);
  EXPECT_LE(found[1].interval.lo, 3); // half of the throws are at most 3
  EXPECT_GE(found[1].interval.hi, 3);
  EXPECT_EQ(found[2].value, 4);
  EXPECT_EQ(found[2].interval.lo, 4);
  EXPECT_EQ(found[2].interval.hi, 4);
  EXPECT_EQ(found[3].value, 6);
}

TEST(Quantiles, TooFewCalls_IntervalEndIsInfinite) {
  const auto found = mc::quantiles([](Unit u) { return u[0]; }, 1, std::array{1e-6, 1 - 1e-6}, {.calls = 1000});
  EXPECT_EQ(found[0].interval.lo, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(found[1].interval.hi, std::numeric_limits<double>::infinity());
}

TEST(Quantiles, CancelThrows) {
  std::atomic<bool> cancel = false;
  const auto f = [&](Unit u) {
    cancel = true;
    return u[0];
  };
  EXPECT_THROW(mc::quantiles(f, 1, std::array{0.5}, {.threads = 1, .cancel = &cancel}), mc::Error);
}

TEST(Quantiles, RefusesNonsense) {
  const auto f = [](Unit u) { return u[0]; };
  const std::array half = {0.5}, one = {1.0};
  EXPECT_THROW(mc::quantiles(f, 0, half), mc::Error);
  EXPECT_THROW(mc::quantiles(f, 1, {}), mc::Error);
  EXPECT_THROW(mc::quantiles(f, 1, one), mc::Error);
  EXPECT_THROW(mc::quantiles({}, 1, half), mc::Error);
  EXPECT_THROW(mc::quantiles(f, 1, half, {.calls = 30}), mc::Error);
  EXPECT_THROW(mc::quantiles(f, 1, half, {.calls = std::uint64_t{1} << 40}), mc::Error);
  EXPECT_THROW(mc::quantiles([](Unit) { return std::nan(""); }, 1, half), mc::Error);
}

} // namespace
