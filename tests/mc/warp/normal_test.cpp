#include <mc/warp/normal.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class NormalOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(NormalOver, Scalars);

TYPED_TEST(NormalOver, ObeysTheLaws) {
  using S = TypeParam;
  // Up to 8 sigma the density has condition number 1 + t^2 = 65.
  for (const double sigma : {1e-10, 1.0, 1e10})
    EXPECT_WARP_LAWS(Normal<S>(S(0), S(sigma)), {.name = fmt::format("sigma {}", sigma),
                                                 .statistics = {.samples = sigma == 1.0 ? 50'000u : 0u},
                                                 .invert_eps = 16,
                                                 .sample_eps = 16,
                                                 .pdf_eps = 80});
}

TEST(Normal, Quantiles) {
  const Normal<double> n;
  EXPECT_NEAR(n.sample(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(n.sample(0.25), -0.6744897501960817, 1e-15);
  EXPECT_EQ(n.sample(0.5), 0);
  EXPECT_TRUE(std::isfinite(n.sample(0))) << "Box and Muller's transform is infinite here";
  EXPECT_LT(n.sample(0), -8);
}

TEST(Normal, RefusesNonsense) {
  EXPECT_THROW(Normal<double>(0, 0), Error);
  EXPECT_THROW(Normal<double>(0, -1), Error);
  EXPECT_THROW(Normal<double>(NAN, 1), Error);
}

} // namespace
} // namespace mc
