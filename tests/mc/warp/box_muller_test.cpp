#include <mc/warp/box_muller.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class BoxMullerOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BoxMullerOver, Scalars);

TYPED_TEST(BoxMullerOver, ObeysTheLaws) {
  using S = TypeParam;
  for (const double sigma : {1e-4, 1.0, 3.0})
    EXPECT_WARP_LAWS(
        BoxMuller<S>(S(sigma)),
        {.name = fmt::format("sigma {}", sigma), .samples = 0, .points = 64, .invert_eps = 8, .pdf_eps = 16});
}

TEST(BoxMuller, IsSafeAtZero) { EXPECT_EQ(BoxMuller<float>{}.sample({0, 0}), Vec2<float>(0, 0)); }

TEST(BoxMuller, RefusesNonsense) {
  for (const double sigma : {0.0, -1.0, HUGE_VAL, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(BoxMuller<double>{sigma}, Error);
}

} // namespace
} // namespace mc
