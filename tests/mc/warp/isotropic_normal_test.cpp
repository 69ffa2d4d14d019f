#include <mc/warp/isotropic_normal.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class IsotropicNormalOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(IsotropicNormalOver, Scalars);

TYPED_TEST(IsotropicNormalOver, ObeysTheLaws) {
  using S = TypeParam;
  for (const double sigma : {1e-4, 1.0, 3.0})
    EXPECT_WARP_LAWS(IsotropicNormal<S>(S(sigma)), {.name = fmt::format("sigma {}", sigma),
                                                    .statistics = {.samples = 0},
                                                    .points = 64,
                                                    .invert_eps = 8,
                                                    .pdf_eps = 16});
}

TEST(IsotropicNormal, IsSafeAtZero) { EXPECT_EQ(IsotropicNormal<float>{}.sample({0, 0}), Vec2<float>(0, 0)); }

TEST(IsotropicNormal, RefusesNonsense) {
  for (const double sigma : {0.0, -1.0, HUGE_VAL, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(IsotropicNormal<double>{sigma}, Error);
}

} // namespace
} // namespace mc
