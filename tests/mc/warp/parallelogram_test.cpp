#include <mc/warp/parallelogram.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class ParallelogramOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ParallelogramOver, Scalars);

TYPED_TEST(ParallelogramOver, ObeysTheLaws) {
  using S = TypeParam;
  const UniformParallelogram<S> warp{{Vec3<S>(0, 0, 0), Vec3<S>(1, 2, 3), Vec3<S>(-1, 0, S(0.5))}};
  EXPECT_WARP_LAWS(warp, {.statistics = {.samples = 0}, .points = 64, .invert_eps = 16, .pdf_eps = 8});
}

TEST(UniformParallelogram, DensityIsOneOverTheArea) {
  const UniformParallelogram<double> warp{{{1, 1, 1}, {2, 0, 0}, {0, 3, 0}}};
  EXPECT_DOUBLE_EQ(warp.pdf({2, 2, 1}), 1.0 / 6);
  EXPECT_EQ(warp.pdf({2, 2, 1.1}), 0);
  EXPECT_EQ(warp.pdf({4, 2, 1}), 0);
}

} // namespace
} // namespace mc
