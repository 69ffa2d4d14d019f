#include <mc/warp/power.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class PowerOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(PowerOver, Scalars);

TYPED_TEST(PowerOver, ObeysTheLaws) {
  using S = TypeParam;
  for (const double n : {0.0, 0.5, 1.0, 10.0, 1e3})
    EXPECT_WARP_LAWS(Power<S>(S(n)), {.name = fmt::format("n {}", n),
                                      .statistics = {.samples = n == 10 ? 50'000u : 0u},
                                      .invert_eps = 8 + n / 2,
                                      .pdf_eps = 16});
}

TEST(Power, RefusesNonsense) {
  for (const double n : {-0.5, HUGE_VAL, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(Power<double>{n}, Error);
}

} // namespace
} // namespace mc
