#include <mc/warp/exponential.h>

#include <mc/gtest/matchers.h>

#include <cmath>

namespace mc {
namespace {

template <class S> class ExponentialOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ExponentialOver, Scalars);

TYPED_TEST(ExponentialOver, ObeysTheLaws) {
  using S = TypeParam;
  for (const double rate : {1e-20, 1.0, 1e20})
    EXPECT_WARP_LAWS(Exponential<S>(S(rate)), {.name = fmt::format("rate {}", rate),
                                               .statistics = {.samples = rate == 1 ? 50'000u : 0u},
                                               .invert_eps = 8,
                                               .pdf_eps = 16});
}

TYPED_TEST(ExponentialOver, TrimmedObeysTheLawsFromFlatToSteep) {
  using S = TypeParam;
  for (const double rate : {0.0, 1e-12, 1e-3, 1.0, 10.0, 1e3, -1e-3, -1.0, -10.0, -1e3})
    EXPECT_WARP_LAWS(TrimmedExponential<S>(S(rate), S(2)), {.name = fmt::format("rate {}", rate),
                                                            .statistics = {.samples = 0},
                                                            .invert_eps = std::max(16.0, -2 * rate),
                                                            .pdf_eps = 16});
}

TEST(TrimmedExponential, IsTheExponentialGivenTheInterval) {
  const TrimmedExponential<double> cut(3, 0.5);
  const Exponential<double> whole(3);
  for (const double x : {0.0, 0.1, 0.5}) EXPECT_NEAR(cut.pdf(x), whole.pdf(x) / whole.invert(0.5), 1e-14);
  EXPECT_EQ(cut.pdf(0.6), 0);
  EXPECT_EQ(cut.pdf(-0.1), 0);
}

TEST(Exponential, RefusesNonsense) {
  for (const double rate : {0.0, -1.0, HUGE_VAL, 1e-310, std::nan("")}) EXPECT_THROW(Exponential<double>{rate}, Error);
  for (const double length : {0.0, -1.0, HUGE_VAL, std::nan("")})
    EXPECT_THROW((TrimmedExponential<double>(1, length)), Error);
  for (const double rate : {HUGE_VAL, std::nan("")}) EXPECT_THROW((TrimmedExponential<double>(rate, 1)), Error);
}

} // namespace
} // namespace mc
