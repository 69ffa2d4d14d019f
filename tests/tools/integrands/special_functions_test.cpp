#include <integrands/expression.h>
#include <integrands/special_functions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace {

double value(const std::string& expression, double x = 0, double y = 0) {
  return carlo::parse_function(expression, {"x", "y"})(std::vector{x, y});
}

bool is_close(double a, long double truth, double tolerance) {
  return std::abs(static_cast<long double>(a) - truth) <= tolerance * std::abs(truth);
}

// The oracles are the C++ library's own functions in long double. 1000 random arguments for each function.
TEST(SpecialFunctions, AgreeWithTheStandardLibrary) {
  std::mt19937 random(1);
  const auto between = [&](double lo, double hi) { return std::uniform_real_distribution<>(lo, hi)(random); };
  const auto gamma = carlo::parse_function("gamma(x)", {"x", "y"}),
             beta = carlo::parse_function("beta(x, y)", {"x", "y"}),
             lgamma = carlo::parse_function("lgamma(x)", {"x", "y"}),
             erfc = carlo::parse_function("erfc(x)", {"x", "y"}),
             j = carlo::parse_function("besselj(y, x)", {"x", "y"}),
             y = carlo::parse_function("bessely(y, x)", {"x", "y"});
  for (int i = 0; i < 1000; ++i) {
    const double a = between(0.01, 60), b = between(0.01, 20), nu = i % 2 ? std::floor(b) : b;
    const std::vector<double> ab = {a, b}, order = {a, nu};
    EXPECT_TRUE(is_close(gamma(ab), std::tgamma(static_cast<long double>(a)), 1e-13)) << a;
    EXPECT_TRUE(is_close(gamma(std::vector{-b, 0.0}), std::tgamma(-static_cast<long double>(b)), 1e-12)) << b;
    EXPECT_NEAR(lgamma(ab), std::lgamma(a), 1e-13 * (1 + std::abs(std::lgamma(a)))) << a;
    EXPECT_NEAR(lgamma(std::vector{-b, 0.0}), std::lgamma(-b), 1e-12 * (1 + std::abs(std::lgamma(-b)))) << b;
    EXPECT_TRUE(is_close(beta(ab), std::beta(static_cast<long double>(a), static_cast<long double>(b)), 1e-11))
        << a << " " << b;
    EXPECT_TRUE(is_close(erfc(std::vector{b, 0.0}), std::erfc(static_cast<long double>(b)), 1e-13)) << b;
    // Between its zeros a Bessel function has the size of its envelope.
    const long double jv = std::cyl_bessel_j(static_cast<long double>(nu), static_cast<long double>(a)),
                      yv = std::cyl_neumann(static_cast<long double>(nu), static_cast<long double>(a));
    EXPECT_NEAR(j(order), jv, 1e-11 * std::max<double>(std::abs(jv), a > nu ? 1 / std::sqrt(a) : 0)) << nu << " " << a;
    EXPECT_NEAR(y(order), yv, 1e-11 * std::max<double>(std::abs(yv), a > nu ? 1 / std::sqrt(a) : 0)) << nu << " " << a;
  }
}

TEST(SpecialFunctions, NormalQuantileInvertsTheDistribution) {
  for (const double p : {1e-300, 1e-100, 1e-20, 1e-5, 0.1, 0.5, 0.7, 0.999, 1 - 0x1p-53}) {
    const double x = carlo::normal_quantile_of(p);
    EXPECT_NEAR(value("normal_cdf(x)", x) / p, 1, 1e-12 * (1 + x * x)) << p;
    EXPECT_EQ(value("normal_quantile(x)", p), x);
  }
  EXPECT_EQ(carlo::normal_quantile_of(0), -HUGE_VAL);
  EXPECT_EQ(carlo::normal_quantile_of(1), HUGE_VAL);
  EXPECT_TRUE(std::isnan(carlo::normal_quantile_of(1.1)));
  EXPECT_NEAR(value("normal_pdf(x)", 1.5), std::exp(-1.125) / std::sqrt(2 * M_PI), 1e-16);
}

TEST(SpecialFunctions, HaveTheirConventions) {
  EXPECT_EQ(value("sinc(x)", 0), 1);
  EXPECT_EQ(value("sinc(x)", 2), std::sin(2.0) / 2);
  EXPECT_EQ(value("heaviside(x) + 10*heaviside(y)", -1, 2), 10);
  EXPECT_EQ(value("heaviside(x)", 0), 0.5);
  EXPECT_EQ(value("fmod(x, 3)", -7), -1);
  EXPECT_EQ(value("ceil(x) + cbrt(y)", 0.5, 27), 4);
  EXPECT_EQ(value("hypot(3*x, 4*x)", 1), 5);
  EXPECT_EQ(value("expm1(x) - log1p(y)", 1e-20, 1e-20), 0);
  EXPECT_EQ(value("besselj(1, x)", -1.5), -value("besselj(1, x)", 1.5)) << "a whole order allows x < 0";
  EXPECT_EQ(value("bessely(0, x)", 0), -HUGE_VAL);
  EXPECT_EQ(value("lgamma(x)", -3), HUGE_VAL);
}

// No argument ends in an exception or a loop.
TEST(SpecialFunctions, AcceptAnyArguments) {
  const double inf = HUGE_VAL, extremes[] = {0.0,
                                             -0.0,
                                             1e-320,
                                             1e-300,
                                             1.0,
                                             -1.0,
                                             -1.5,
                                             1e5,
                                             -1e5,
                                             1e300,
                                             inf,
                                             -inf,
                                             std::numeric_limits<double>::quiet_NaN()};
  for (const carlo::NamedFunction& f : carlo::special_functions())
    for (const double x : extremes)
      for (const double y : extremes) {
        const auto call = [&](auto* function) {
          if constexpr (std::is_invocable_v<decltype(function), double>) return function(x);
          else return function(x, y);
        };
        EXPECT_NO_THROW(std::visit(call, f.f)) << f.name << " " << x << " " << y;
      }
}

TEST(SpecialFunctions, TheirNamesAreFreeForVariables) {
  EXPECT_EQ(carlo::parse_function("gamma(gamma) + beta", {"gamma", "beta"})(std::vector{5.0, 1.0}), 25);
  EXPECT_NO_THROW(carlo::require_variable_name("beta"));
}

} // namespace
