#include <mc/warp/tent.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class TentOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(TentOver, Scalars);

TYPED_TEST(TentOver, ObeysTheLaws) {
  using S = TypeParam;
  // The error of a sample is relative to the radius; the law states it relative to max(1, |x|).
  for (const double radius : {1e-20, 0.5, 1e20})
    EXPECT_WARP_LAWS(Tent<S>(S(0), S(radius)), {.name = fmt::format("radius {}", radius),
                                                .statistics = {.samples = radius == 0.5 ? 50'000u : 0u},
                                                .invert_eps = 8,
                                                .sample_eps = 8 * std::max(1.0, radius),
                                                .pdf_eps = 16});
}

// The variance of a tent of half width h is h^2 / 6. Alpha 1e-3, fixed seed.
TYPED_TEST(TentOver, Variance) {
  using S = TypeParam;
  Pcg random(8);
  std::vector<double> squares;
  for (int i = 0; i < 100'000; ++i) squares.push_back(sqr(double(Tent<S>(S(0), S(2)).sample(random.uniform<S>()))));
  EXPECT_MEAN(squares, 4.0 / 6);
}

TEST(Tent, RefusesNonsense) {
  EXPECT_THROW(Tent<double>(0, 0), Error);
  EXPECT_THROW(Tent<double>(NAN, 1), Error);
  EXPECT_THROW(Tent<double>(0, INFINITY), Error);
  EXPECT_EQ(Tent<double>().pdf(1.5), 0);
  EXPECT_EQ(Tent<double>().pdf(NAN), 0);
}

} // namespace
} // namespace mc
