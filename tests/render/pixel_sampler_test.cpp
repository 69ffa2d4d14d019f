#include <render/pixel_sampler.h>

#include <render/scene/builder.h>

#include <mc/core/error.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

Scene ball_under_the_sky() {
  SceneBuilder builder;
  builder.add(Light(ConstantBackground(Spectrum(1, 2, 3))));
  builder.add(Sphere(Vec3d(0, 0, -3), 1), {builder.add(Lambert())});
  return builder.build();
}

// Samples taken in any parts are the samples taken at once.
TEST(SampleTaker, PartsAreTheWhole) {
  const Scene scene = ball_under_the_sky();
  for (const PixelSampler sampler : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol}) {
    const SampleTaker taker(scene, {}, sampler, 5, 4, {3, 2, {0, 0, 3, 2}});
    Film whole(3, 2, 4), parts(3, 2, 4);
    const std::vector<std::uint32_t> none = {0, 0, 0}, some = {1, 6, 19}, all = {40, 7, 19};
    const Tally one = taker.take(1, none, all, whole);
    Tally two = taker.take(1, none, some, parts);
    two.merge(taker.take(1, some, all, parts));
    EXPECT_EQ(one.samples, 66u);
    EXPECT_EQ(two.samples, 66u);
    EXPECT_EQ(one.rays, two.rays);
    EXPECT_EQ(whole.rays(0, 1) + whole.rays(1, 1) + whole.rays(2, 1), one.rays);
    for (int x = 0; x < 3; ++x) {
      const PixelEstimate a = whole.estimate(x, 1), b = parts.estimate(x, 1);
      EXPECT_EQ(a.samples, all[std::size_t(x)]);
      EXPECT_EQ(a.sets, 4);
      // Sums of the same numbers in another order.
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(a.mean[c], b.mean[c], 1e-12) << name(sampler);
        EXPECT_NEAR(a.variance[c], b.variance[c], 1e-12) << name(sampler);
      }
    }
    EXPECT_EQ(whole.estimate(0, 0).samples, 0u);
  }
}

TEST(SampleTaker, NamesAreTheirOwnInverse) {
  EXPECT_THROW(sampler_from("sobel"), mc::Error);
  for (const PixelSampler s : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol})
    EXPECT_EQ(sampler_from(name(s)), s);
}

TEST(Tally, KeepsTheFirstInvalidSampleInAnyOrder) {
  const InvalidSample late{0, 0, 2, 0}, early{5, 5, 1, 9};
  Tally a, b;
  a.add(late);
  b.add(early);
  a.merge(b);
  EXPECT_EQ(a.invalid, 2u);
  EXPECT_EQ(a.first.pass, 1u);
  a.add(late);
  EXPECT_EQ(a.first.x, 5);
}

} // namespace
