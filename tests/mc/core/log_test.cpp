#include <mc/core/log.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

template <class S> class LogOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(LogOver, Scalars);

TYPED_TEST(LogOver, ComplementIsAccurate) {
  using S = TypeParam;
  constexpr S eps = std::numeric_limits<S>::epsilon();
  mc::Pcg random(5);
  for (int i = 0; i < 60'000; ++i) {
    const double v = random.uniform<double>();
    const S u = i % 3 == 0 ? S(v) : i % 3 == 1 ? S(std::pow(1e-30, v)) : S(1) - S(std::pow(double(eps), v));
    if (!(u > 0 && u < 1)) continue;
    const long double x = std::log1p(-static_cast<long double>(u));
    EXPECT_LE(std::abs((mc::log_of_complement(u) - x) / x), 2 * eps) << u;
  }
  EXPECT_EQ(mc::log_of_complement(S(0)), 0);
  EXPECT_EQ(mc::log_of_complement(S(0.5)), S(-std::log(2.0L)));
}

} // namespace
