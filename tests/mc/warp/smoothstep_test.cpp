#include <mc/warp/smoothstep.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class SmoothstepOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(SmoothstepOver, Scalars);

TYPED_TEST(SmoothstepOver, ObeysTheLaws) {
  EXPECT_WARP_LAWS(Smoothstep<TypeParam>{}, {.statistics = {.samples = 50'000}, .invert_eps = 8, .pdf_eps = 16});
}

TEST(Smoothstep, KnownValues) {
  const Smoothstep<double> warp;
  EXPECT_DOUBLE_EQ(warp.pdf(0.5), 1);
  EXPECT_DOUBLE_EQ(warp.pdf(1), 2);
  EXPECT_EQ(warp.pdf(1.1), 0);
}

} // namespace
} // namespace mc
