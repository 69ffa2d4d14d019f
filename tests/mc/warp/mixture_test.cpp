#include <mc/warp/hemisphere.h>
#include <mc/warp/mixture.h>
#include <mc/warp/tent.h>
#include <mc/warp/uniform.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> auto half_and_half(S a, S b) {
  return Mixture(std::array<S, 2>{a, b}, UniformHemisphere<S>{}, CosineHemisphere<S>{});
}

TEST(Mixture, ObeysTheLaws) {
  // Stretching u0 magnifies its rounding by 1 / weight, and by more at the rim of the cosine lobe: 64 eps of the
  // sample.
  EXPECT_WARP_LAWS(half_and_half(0.3f, 0.7f), {.statistics = {.samples = 50'000}, .sample_eps = 64, .pdf_eps = 16});
  EXPECT_WARP_LAWS(half_and_half(0.3, 0.7), {.statistics = {.samples = 50'000}, .sample_eps = 64, .pdf_eps = 16});
}

TEST(Mixture, WeightsNeedNotSumToOneAndMayBeZero) {
  const Vec3<double> z(0, 0, 1);
  EXPECT_DOUBLE_EQ(half_and_half(2.0, 6.0).pdf(z), 0.25 / (2 * pi<double>)+0.75 / pi<double>);
  EXPECT_DOUBLE_EQ(half_and_half(0.0, 6.0).pdf(z), 1 / pi<double>);
  const auto first_only = half_and_half(1.0, 0.0);
  const auto w = first_only.sample({one_minus_epsilon<double>, 0.5});
  EXPECT_NEAR(w.z(), UniformHemisphere<double>{}.sample({one_minus_epsilon<double>, 0.5}).z(), 1e-7);
}

TEST(Mixture, ThreeComponentsInOneDimension) {
  const Mixture mixture(std::array{1.0, 2.0, 1.0}, Tent<double>(0, 1), Tent<double>(0, 1), Tent<double>(0, 1));
  EXPECT_WARP_LAWS(mixture, {.statistics = {.samples = 50'000}, .pdf_eps = 16});
}

TEST(Mixture, WeightsMayBeAsLargeOrSmallAsTheScalarGoes) {
  const float huge = std::numeric_limits<float>::max(), tiny = std::numeric_limits<float>::denorm_min();
  const Vec3<float> z(0, 0, 1);
  for (const float w : {tiny, 1e-40f, 3e38f, huge}) {
    const auto mixture = half_and_half(w, w);
    EXPECT_EQ(mixture.pdf(z), half_and_half(1.0f, 1.0f).pdf(z)) << w;
    EXPECT_TRUE(mixture.sample({one_minus_epsilon<float>, 0.5f}).allFinite()) << w;
  }
  for (const auto& mixture : {half_and_half(tiny, huge), half_and_half(huge, tiny)})
    for (const float u : {0.0f, one_minus_epsilon<float>}) EXPECT_GT(mixture.pdf(mixture.sample({u, 0.5f})), 0);
}

TEST(Mixture, RefusesNonsense) {
  EXPECT_THROW(half_and_half(0.0, 0.0), Error);
  EXPECT_THROW(half_and_half(-1.0, 2.0), Error);
  EXPECT_THROW(half_and_half(1.0, double(NAN)), Error);
}

} // namespace
// A weight that is denormal relative to the largest would give samples a density of 0.
TEST(Mixture, VanishingWeightsCountAsZero) {
  const mc::Mixture mixture({1e-41f, 1.0f}, mc::UniformInterval<float>(0, 1e6f),
                            mc::UniformInterval<float>(5e5f, 1e6f));
  EXPECT_GT(mixture.pdf(mixture.sample(0.0f)), 0);
}

} // namespace mc
