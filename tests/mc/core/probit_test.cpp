#include <mc/core/probit.h>

#include <mc/core/error.h>
#include <mc/random/pcg.h>

#include <boost/math/special_functions/erf.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

long double exact(long double u) { return -std::sqrt(2.0L) * boost::math::erfc_inv(2 * u); }

template <class S> class ProbitOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ProbitOver, Scalars);

// Uniform numbers, tails down to the least probability, and the neighbourhood of the zero.
TYPED_TEST(ProbitOver, IsAccurate) {
  using S = TypeParam;
  constexpr S eps = std::numeric_limits<S>::epsilon(), least = eps / 4;
  mc::Pcg random(3);
  for (int i = 0; i < 60'000; ++i) {
    const double v = random.uniform<double>();
    const S u = i % 3 == 0 ? S(v) : i % 3 == 1 ? S(std::pow(double(least), v)) : S(0.5 + 0.01 * (v - 0.5));
    const long double x = exact(u);
    if (x == 0) continue;
    EXPECT_LE(std::abs((mc::probit(u) - x) / x), 4 * eps) << u;
  }
}

TYPED_TEST(ProbitOver, EndsAreFiniteAndSymmetric) {
  using S = TypeParam;
  EXPECT_EQ(mc::probit(S(0.5)), 0);
  EXPECT_EQ(mc::probit(S(0)), mc::probit(std::numeric_limits<S>::epsilon() / 4));
  EXPECT_EQ(mc::probit(S(1)), -mc::probit(S(0)));
  for (const S u : {S(0.25), S(0.0625), S(0.001953125)}) EXPECT_EQ(mc::probit(u), -mc::probit(1 - u)) << u;
  EXPECT_LT(mc::probit(S(0.075) - S(1e-6)), mc::probit(S(0.075) + S(1e-6))) << "where the fits meet";
}

TYPED_TEST(ProbitOver, ManyHaveTheSameBits) {
  using S = TypeParam;
  mc::Pcg random(4);
  for (const std::size_t n : {0u, 1u, 7u, 256u, 1000u}) {
    std::vector<S> u(n), x(n);
    for (std::size_t i = 0; i < n; ++i) u[i] = i % 5 == 0 ? S(i) / S(n) : S(std::pow(random.uniform<double>(), 8));
    mc::probits(u, x);
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(x[i], mc::probit(u[i])) << u[i];
    std::vector<S> in_place = u;
    mc::probits(in_place, in_place);
    EXPECT_EQ(in_place, x);
  }
  std::vector<S> three(3), four(4);
  EXPECT_THROW(mc::probits(three, four), mc::Error);
}

} // namespace
