#include <mc/warp/ball.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class BallOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BallOver, Scalars);

TYPED_TEST(BallOver, ObeysTheLaws) {
  EXPECT_WARP_LAWS(UniformBall<TypeParam>{}, {.statistics = {.samples = 50'000}, .invert_eps = 8, .pdf_eps = 4});
}

// E |p|^2 = 3/5. Alpha 1e-3, fixed seed.
TYPED_TEST(BallOver, MeanSquareRadius) {
  using S = TypeParam;
  Pcg random(8);
  std::vector<double> squares;
  for (int i = 0; i < 100'000; ++i)
    squares.push_back(double(UniformBall<S>{}.sample(random.point<S, 3>()).squaredNorm()));
  EXPECT_MEAN(squares, 0.6);
}

TEST(Ball, PdfIsZeroOutside) {
  EXPECT_EQ(UniformBall<double>{}.pdf({1, 0.1, 0}), 0);
  EXPECT_EQ(UniformBall<double>{}.pdf({0, 0, double(NAN)}), 0);
}

} // namespace
} // namespace mc
