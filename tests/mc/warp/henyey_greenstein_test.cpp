#include <mc/warp/henyey_greenstein.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class HenyeyGreensteinOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(HenyeyGreensteinOver, Scalars);

TYPED_TEST(HenyeyGreensteinOver, ObeysTheLaws) {
  using S = TypeParam;
  for (const double g : {-0.9999, -0.5, 0.0, 1e-9, 0.5, 0.9}) {
    const HenyeyGreenstein<S> warp{S(g)};
    EXPECT_WARP_LAWS(warp, {.name = fmt::format("g {}", g),
                            .statistics = {.samples = std::abs(g) <= 0.9 ? 50'000u : 0u},
                            .invert_eps = 16 / (1 - std::abs(g)),
                            .pdf_eps = 16});
  }
}

TYPED_TEST(HenyeyGreensteinOver, IsNotClampedNearOne) {
  using S = TypeParam;
  for (const double h : {1e-2, 1e-4, 1e-6}) {
    const auto warp = HenyeyGreenstein<S>::from_one_minus_abs_g(S(h));
    EXPECT_WARP_LAWS(warp, {.name = fmt::format("1 - g = {}", h),
                            .statistics = {.samples = 0},
                            .invert_eps = 16 / h,
                            .sample_eps = 16,
                            .pdf_eps = 16});
    EXPECT_NEAR(double(warp.pdf({0, 0, 1})) * 4 * std::numbers::pi * h * h / (2 - h), 1,
                16 * double(std::numeric_limits<S>::epsilon()));
  }
}

// The mean cosine is g, also beyond 0.99, where some renderers clamp g. Averages over strata of u, as a quadrature
// rule does.
TEST(HenyeyGreenstein, MeanCosineIsG) {
  for (const double g : {-0.9999, -0.3, 0.9, 0.999, 0.9999}) {
    const HenyeyGreenstein<double> warp(g);
    double sum = 0;
    const int n = 1'000'000;
    for (int i = 0; i < n; ++i) sum += warp.sample({(i + 0.5) / n, 0.25}).z();
    EXPECT_NEAR(sum / n, g, 1e-8);
  }
}

TEST(HenyeyGreenstein, RefusesNonsense) {
  for (const double g : {-1.0, 1.0, 1.5, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(HenyeyGreenstein<double>{g}, Error);
  for (const double h : {0.0, -1.0, 1.5, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(HenyeyGreenstein<double>::from_one_minus_abs_g(h), Error);
}

} // namespace
} // namespace mc
