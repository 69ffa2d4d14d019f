#include <mc/warp/von_mises_fisher.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class VonMisesFisherOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(VonMisesFisherOver, Scalars);

// kappa t stays below 6 for 256 random u, so the bound (8 + 4 kappa t) eps stays below 32.
TYPED_TEST(VonMisesFisherOver, ObeysTheLawsFromUniformToNeedle) {
  using S = TypeParam;
  for (const double kappa : {0.0, 1e-9, 1e-3, 1.0, 3.0, 5.0, 30.0, 1e4, 1e8}) {
    const VonMisesFisher<S> warp{S(kappa)};
    EXPECT_WARP_LAWS(warp, {.name = fmt::format("kappa {}", kappa),
                            .statistics = {.samples = kappa <= 30 ? 50'000u : 0u},
                            .invert_eps = 16,
                            .sample_eps = 16,
                            .pdf_eps = 32});
  }
}

// The last u lie next to -z, where 1 - z has lost the digits of the distance.
TYPED_TEST(VonMisesFisherOver, TheFarPoleKeepsItsDigits) {
  using S = TypeParam;
  const S step = std::numeric_limits<S>::epsilon() / 2;
  for (S kappa = S(0.25); kappa < 40; kappa += S(0.25))
    for (const int steps : {1, 2, 3, 10, 1000}) {
      const Vec3<S> w = VonMisesFisher<S>(kappa).sample({1 - S(steps) * step, 0});
      const double s =
          std::log1p(double(steps) * double(step) * std::expm1(2 * double(kappa))) / double(kappa); // 1 + z
      EXPECT_NEAR(double(w.x()), std::sqrt(s * (2 - s)), 16 * 2 * double(step)) << "kappa " << kappa << ", " << steps;
    }
}

TEST(VonMisesFisher, TinyKappaIsUniform) {
  for (const double kappa : {0.0, 1e-300, 1e-9}) {
    const VonMisesFisher<double> warp(kappa);
    EXPECT_NEAR(warp.pdf({0, 0, 1}) * 4 * std::numbers::pi, 1, 2e-9);
    EXPECT_NEAR(warp.sample({0.25, 0.1}).z(), 0.5, 1e-9);
  }
}

TEST(VonMisesFisher, RefusesNonsense) {
  for (const double kappa : {-1.0, HUGE_VAL, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(VonMisesFisher<double>{kappa}, Error);
}

} // namespace
} // namespace mc
