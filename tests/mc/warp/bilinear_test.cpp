#include <mc/warp/bilinear.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class BilinearOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BilinearOver, Scalars);

TYPED_TEST(BilinearOver, ObeysTheLawsWithZeroEdgesAndHugeWeights) {
  using S = TypeParam;
  for (const std::array<double, 4>& w : {std::array{1., 2., 3., 4.},
                                         {1., 1., 1., 1.},
                                         {0., 0., 0., 1.},
                                         {1., 0., 0., 0.},
                                         {1., 0., 0., 1.},
                                         {0., 0., 1., 1.},
                                         {0., 1., 0., 1.},
                                         {1e30, 1., 1e30, 0.},
                                         {1e30, 1e30, 1e30, 1e30}})
    EXPECT_WARP_LAWS(Bilinear<S>(S(w[0]), S(w[1]), S(w[2]), S(w[3])),
                     {.name = fmt::format("{} {} {} {}", w[0], w[1], w[2], w[3]),
                      .statistics = {.samples = 0},
                      .points = 64,
                      .pdf_eps = 16});
}

TEST(Bilinear, RefusesNonsense) {
  EXPECT_THROW((Bilinear<double>(0, 0, 0, 0)), Error);
  for (const double w : {-1.0, HUGE_VAL, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW((Bilinear<double>(1, w, 1, 1)), Error);
    EXPECT_THROW((Bilinear<double>(w, 1, 1, 1)), Error);
  }
}

} // namespace
} // namespace mc
