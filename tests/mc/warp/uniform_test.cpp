#include <mc/warp/uniform.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class UniformOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(UniformOver, Scalars);

TYPED_TEST(UniformOver, IntervalObeysTheLaws) {
  using S = TypeParam;
  EXPECT_WARP_LAWS(UniformInterval<S>{}, {.statistics = {.samples = 20'000}, .invert_eps = 4});
  EXPECT_WARP_LAWS((UniformInterval<S>{S(-0.5), S(0.5)}), {.statistics = {.samples = 20'000}, .invert_eps = 4});
  EXPECT_WARP_LAWS((UniformInterval<S>{S(100), S(101)}), {.statistics = {.samples = 0}, .invert_eps = 404});
}

TYPED_TEST(UniformOver, BoxObeysTheLaws) {
  using S = TypeParam;
  EXPECT_WARP_LAWS((UniformBox<S, 2>{Vec2<S>(S(-0.5), S(-0.5)), Vec2<S>(S(0.5), S(0.5))}),
                   {.statistics = {.samples = 20'000}, .invert_eps = 4});
  EXPECT_WARP_LAWS((UniformBox<S, 3>{Vec3<S>(-3, 0, 1), Vec3<S>(-1, 1, 2)}),
                   {.statistics = {.samples = 20'000}, .invert_eps = 8});
}

TEST(Uniform, RefusesNonsense) {
  EXPECT_THROW((UniformInterval<double>{1, 1}), Error);
  EXPECT_THROW((UniformInterval<double>{0, HUGE_VAL}), Error);
  EXPECT_THROW((UniformBox<double, 2>{Vec2<double>(0, 0), Vec2<double>(1, double(NAN))}), Error);
  EXPECT_EQ(UniformInterval<double>{}.pdf(1.5), 0);
}

} // namespace
} // namespace mc
