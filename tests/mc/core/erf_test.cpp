#include <mc/check/subject/oracle.h>
#include <mc/core/erf.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace mc {
namespace {

template <class S> class ErfOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ErfOver, Scalars);

template <class S> double error_in_eps(S value, const Oracle& exact) {
  return std::abs(double((Oracle(value) - exact) / exact)) / double(std::numeric_limits<S>::epsilon());
}

TYPED_TEST(ErfOver, IsAsExactAsStated) {
  using S = TypeParam;
  Pcg random(1);
  const double largest = std::is_same_v<S, float> ? 8 : 25; // erfc is denormal beyond
  for (int i = 0; i < 1000; ++i) {
    const S x = S(largest * (2 * random.uniform<double>() - 1));
    EXPECT_LE(error_in_eps(erfc(x), erfc(Oracle(x))), 4) << x;
    const S p = i % 2 ? S(2 * random.uniform<double>()) : S(std::pow(10, -30 * random.uniform<double>()));
    if (p == 0 || p == 1 || p == 2) continue;
    EXPECT_LE(error_in_eps(erfc_inv(p), erfc_inv(Oracle(p))), 4) << p;
  }
  EXPECT_EQ(erfc(S(0)), 1);
  EXPECT_EQ(erfc_inv(S(1)), 0);
}

} // namespace
} // namespace mc
