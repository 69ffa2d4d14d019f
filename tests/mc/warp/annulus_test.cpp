#include <mc/warp/annulus.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class AnnulusOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(AnnulusOver, Scalars);

TYPED_TEST(AnnulusOver, ObeysTheLaws) {
  using S = TypeParam;
  for (const double inner : {0.0, 0.5, 0.99})
    EXPECT_WARP_LAWS(UniformAnnulus<S>(S(inner), 1), {.name = fmt::format("inner {}", inner),
                                                      .statistics = {.samples = 0},
                                                      .points = 64,
                                                      .invert_eps = 8 / (1 - inner),
                                                      .pdf_eps = 8});
}

TEST(UniformAnnulus, RefusesNonsense) {
  EXPECT_THROW((UniformAnnulus<double>(1, 0.5)), Error);
  EXPECT_THROW((UniformAnnulus<double>(0, std::numeric_limits<double>::quiet_NaN())), Error);
}

} // namespace
} // namespace mc
