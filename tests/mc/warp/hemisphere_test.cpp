#include <mc/warp/hemisphere.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class HemisphereOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(HemisphereOver, Scalars);

TYPED_TEST(HemisphereOver, ObeysTheLaws) {
  using S = TypeParam;
  EXPECT_WARP_LAWS(UniformHemisphere<S>{}, {.statistics = {.samples = 50'000}, .invert_eps = 8, .pdf_eps = 2});
  EXPECT_WARP_LAWS(CosineHemisphere<S>{}, {.statistics = {.samples = 50'000}, .invert_eps = 8, .pdf_eps = 16});
}

TYPED_TEST(HemisphereOver, NothingBelowTheHorizon) {
  using S = TypeParam;
  EXPECT_EQ(UniformHemisphere<S>{}.pdf({S(1), S(0), S(-1e-7)}), 0);
  EXPECT_EQ(CosineHemisphere<S>{}.pdf({S(1), S(0), S(0)}), 0);
  EXPECT_EQ(CosineHemisphere<S>{}.pdf({S(0), S(0), S(-1)}), 0);
}

// The mean of cos is 1/2 and 2/3 for the two densities (0.8 for the in-ball mutant). Alpha 1e-3, fixed seed.
TYPED_TEST(HemisphereOver, MeanCosine) {
  using S = TypeParam;
  Pcg random(5);
  std::vector<S> uniform, cosine;
  for (int i = 0; i < 100'000; ++i) {
    const auto u = random.point<S, 2>();
    uniform.push_back(UniformHemisphere<S>{}.sample(u).z());
    cosine.push_back(CosineHemisphere<S>{}.sample(u).z());
  }
  EXPECT_MEAN(uniform, 0.5);
  EXPECT_MEAN(cosine, 2.0 / 3);
}

} // namespace
} // namespace mc
