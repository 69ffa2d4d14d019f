#include <render/pixel_points.h>
#include <render/scene/builder.h>

#include <mc/core/error.h>
#include <mc/sampler/path_sample_stream.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(PixelSampler, NamesAreTheirOwnInverse) {
  EXPECT_THROW(sampler_from("sobel"), mc::Error);
  for (const PixelSampler s : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol})
    EXPECT_EQ(sampler_from(name(s)), s);
}

// For any ranges, sample k is point k / sets of set k % sets. A stratified set continues with another randomisation.
TEST(PixelPoints, AssignSamplesRoundRobin) {
  for (const PixelSampler sampler : {PixelSampler::sobol, PixelSampler::stratified}) {
    const PixelPoints points(sampler, 7, 3);
    for (const std::uint32_t sets : {1u, 2u, 5u})
      for (const auto& [first, last] : {std::pair{0u, 40u}, {3u, 4u}, {11u, 11u}, {6u, 29u}}) {
        std::vector<int> dealt(40);
        for (std::uint32_t set = 0; set < sets; ++set)
          points.for_ranges(set, sets, first, last, [&](const PixelPoints::PointRange& range) {
            EXPECT_LT(range.begin, range.end);
            EXPECT_LE(range.end, points.set_size);
            EXPECT_EQ(range.pass % sets, set);
            EXPECT_TRUE(sampler == PixelSampler::stratified || range.pass == set);
            for (std::uint32_t i = range.begin; i < range.end; ++i) ++dealt[set + sets * (range.pass / sets * 3 + i)];
          });
        for (std::uint32_t k = 0; k < 40; ++k) EXPECT_EQ(dealt[k], k >= first && k < last) << k;
      }
  }
}

// Pixels, passes and seeds have independent points.
TEST(PixelPoints, DependOnPixelPassAndSeed) {
  using Points = mc::SobolPairs;
  const PixelPoints one(PixelSampler::sobol, 7, 1), two(PixelSampler::sobol, 8, 1);
  const std::uint64_t seed = one.point_set<Points>(3, 4, {0, 0, 1}).seed;
  EXPECT_EQ(one.point_set<Points>(3, 4, {0, 5, 9}).seed, seed);
  EXPECT_NE(one.point_set<Points>(4, 3, {0, 0, 1}).seed, seed);
  EXPECT_NE(one.point_set<Points>(-3, 4, {0, 0, 1}).seed, seed);
  EXPECT_NE(one.point_set<Points>(3, 4, {1, 0, 1}).seed, seed);
  EXPECT_NE(two.point_set<Points>(3, 4, {0, 0, 1}).seed, seed);
}

// The rays of a crop are the rays of the full image. The image has 4x2 pixels and a field of view of 90 degrees. The
// centre of its upper left pixel is 3/4 to the left and 1/4 up, in units of half the width.
TEST(PixelRays, CroppedRaysEqualFullRays) {
  SceneBuilder builder;
  builder.add(Light(ConstantBackground(Spectrum::Ones())));
  builder.set(ThinLens({}, {.fov = 90}));
  const Scene scene = builder.build();
  const mc::IndependentPairs numbers(1, 0);
  mc::IndependentPathStream<Float> stream(numbers, 0);
  for (const Crop& part : {Crop{0, 0, 4, 2}, Crop{2, 1, 1, 1}}) {
    const PixelRays rays(scene, {4, 2, part});
    const Vec3 d = rays.sample(0, 0, Vec2::Zero(), stream).d;
    EXPECT_NEAR(std::abs(d.x() / d.z()), 0.75, 1e-6);
    EXPECT_NEAR(std::abs(d.y() / d.z()), 0.25, 1e-6);
    const Vec3 beside = rays.sample(0, 0, Vec2(Float(0.5), Float(-0.5)), stream).d;
    EXPECT_NEAR(std::abs(beside.x() / beside.z()), 0.5, 1e-6);
    EXPECT_NEAR(std::abs(beside.y() / beside.z()), 0.5, 1e-6);
    EXPECT_EQ(rays.media({}).current, nullptr);
  }
}

} // namespace
