#include <render/render.h>
#include <render/scene/builder.h>

#include <mc/core/error.h>
#include <mc/estimate/moments.h>
#include <mc/stats/chi_square.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace render;

constexpr PixelSampler samplers[] = {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol};

/// Two spheres, the right one of glass by default, on a plane under a small spherical light and a dim sky. The light is
/// outside the view if the tangent of half the field of view is .25.
Scene small_scene(Float sky = Float(0.1), double tan_half = 0.4, const Bsdf& right = Dielectric()) {
  SceneBuilder builder;
  const BsdfId tan = builder.add(Lambert(Spectrum(Float(0.8), Float(0.6), Float(0.4)))), glass = builder.add(right);
  builder.add(Light(ConstantBackground(Spectrum(Float(0.1), sky, Float(0.1)))));
  builder.add(Sphere(Vec3d(0, -101, 0), 100), {tan});
  builder.add(Sphere(Vec3d(-0.7, -0.4, 0), 0.6), {tan});
  builder.add(Sphere(Vec3d(0.7, -0.4, 0), 0.6), {glass});
  builder.add(Sphere(Vec3d(0, 2, 1), 0.4), {tan, Emission{Spectrum::Constant(10)}});
  const double fov = 2 * std::atan(tan_half) * 180 / mc::pi<double>;
  const LensOptions lens{.fov_axis = FovAxis::y, .fov = fov};
  builder.set(ThinLens(Transform::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}), lens));
  return builder.build();
}

RenderOptions small() {
  RenderOptions options;
  options.width = 24;
  options.height = 20;
  return options;
}

TEST(Render, SameBitsForAnyNumberOfThreads) {
  const Scene scene = small_scene();
  for (const PixelSampler sampler : samplers) {
    RenderOptions options = small();
    options.spp = 16;
    options.sampler = sampler;
    options.threads = 1;
    const RenderResult one = render::render(scene, options);
    options.threads = 2;
    const RenderResult two = render::render(scene, options);
    EXPECT_EQ(one.rays, two.rays);
    EXPECT_EQ(one.samples, 16u * 24 * 20);
    int different = 0;
    for (std::size_t i = 0; i < one.image.pixels.size(); ++i)
      different += !(one.image.pixels[i] == two.image.pixels[i]).all() ||
                   !(one.image.variance[i] == two.image.variance[i]).all();
    EXPECT_EQ(different, 0) << name(sampler);
    options.seed = 1;
    const RenderResult other = render::render(scene, options);
    for (std::size_t i = 0; i < one.image.pixels.size(); ++i)
      different += !(one.image.pixels[i] == other.image.pixels[i]).all();
    EXPECT_GE(different, 1) << name(sampler) << ": another seed, the same picture";
  }
}

// Renders of two seeds differ as their error bars state: the sum of squared differences equals the sum of the
// variances. Each pixel is weighted by the mean variance of sixteen other renders. A variance from four replicates is
// too noisy as a weight, and a few caustic pixels would dominate. Over 16 pairs the ratio has a standard deviation of
// .02; over 32 pairs the bound of .08 is more than five of them.
TEST(Render, ErrorBarsAreHonest) {
  const Scene scene = small_scene();
  for (const PixelSampler sampler : samplers) {
    RenderOptions options = small();
    options.spp = 32;
    options.adaptive = false; // a pixel of rare bright paths with few samples would dominate
    options.sampler = sampler;
    std::vector<double> scale(24 * 20, 1e-6);
    for (options.seed = 1000; options.seed < 1016; ++options.seed) {
      const RenderResult r = render::render(scene, options);
      for (std::size_t i = 0; i < scale.size(); ++i) scale[i] += double(r.image.variance[i].mean()) / 16;
    }
    double difference = 0, variance = 0;
    for (std::uint64_t pair = 0; pair < 32; ++pair) {
      options.seed = 2 * pair;
      const RenderResult a = render::render(scene, options);
      options.seed = 2 * pair + 1;
      const RenderResult b = render::render(scene, options);
      for (std::size_t i = 0; i < a.image.pixels.size(); ++i) {
        const double weight = 1 / scale[i];
        difference += weight * double((a.image.pixels[i] - b.image.pixels[i]).square().sum());
        variance += weight * double((a.image.variance[i] + b.image.variance[i]).sum());
      }
    }
    EXPECT_NEAR(difference / variance, 1, 0.08) << name(sampler);
  }
}

/// Statistics over many seeds of one kind of sampling: sums of the image and single pixels, in green.
struct Seeds {
  mc::Moments z, sums; ///< z: error of the sum against `truth`, in units of its own error bar
  std::vector<mc::Moments> pixels;

  Seeds(const Scene& scene, RenderOptions options, std::uint64_t first, double truth) {
    pixels.resize(std::size_t(options.width) * std::size_t(options.height));
    for (options.seed = first; options.seed < first + 200; ++options.seed) {
      const RenderResult r = render::render(scene, options);
      double sum = 0, variance = 0;
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        const auto value = double(r.image.pixels[i][1]);
        pixels[i].add(value);
        sum += value;
        variance += double(r.image.variance[i][1]);
      }
      sums.add(sum);
      z.add((sum - truth) / std::sqrt(variance));
    }
  }
};

// Adaptive sampling: the mean of 200 images equals the mean of even sampling, and their error bars match their errors.
// Sums of 120 pixels are nearly normal: alpha is 0.1 % for each of the three bounds.
TEST(Render, AdaptivePicturesAreUnbiasedWithHonestErrorBars) {
  const Scene scene = small_scene(Float(0.1), 0.25, Lambert());
  RenderOptions options = small();
  options.width = 12;
  options.height = 10;
  options.spp = 64;
  const Seeds even(scene, options, 0, 0);
  options.adaptive = true;
  const double truth = even.sums.mean();
  const Seeds adaptive(scene, options, 1000, truth);
  // The truth has the uncertainty of the mean over even images.
  const double off = (adaptive.sums.mean() - truth) / std::hypot(adaptive.sums.std_error(), even.sums.std_error());
  EXPECT_LE(std::abs(off), 3.29);
  EXPECT_GE(adaptive.z.variance(), 0.70);
  EXPECT_LE(adaptive.z.variance(), 1.36); // chi-square of 199 degrees of freedom
  double squares = 0, compared = 0;
  for (std::size_t i = 0; i < 120; ++i) {
    const mc::Moments &a = adaptive.pixels[i], &e = even.pixels[i];
    if (a.variance() == 0 && a.mean() == e.mean()) continue; // only the sky
    squares += mc::sqr(a.mean() - e.mean()) / (mc::sqr(a.std_error()) + mc::sqr(e.std_error()));
    ++compared;
  }
  EXPECT_GE(compared, 50);
  EXPECT_GE(mc::chi_square_tail(squares, compared), 0.001);
}

// The logarithm of the ratio of the errors is -.07 on average over 72 images. Its standard deviation is .25, since
// errors are estimates themselves. The mean of 24 images exceeds .08 for one set of seeds in 700.
TEST(Render, Adaptive_HasNoLargerErrorThanUniform) {
  const Scene scene = small_scene(Float(0.1), 0.25);
  mc::Moments logarithms;
  for (const PixelSampler sampler : samplers) {
    RenderOptions options = small();
    options.sampler = sampler;
    options.spp = 128;
    for (options.seed = 0; options.seed < 8; ++options.seed) {
      options.adaptive = false;
      const double even = render::render(scene, options).relative_error;
      options.adaptive = true;
      logarithms.add(std::log(render::render(scene, options).relative_error / even));
    }
  }
  EXPECT_LE(logarithms.mean(), 0.08);
}

TEST(Render, Adaptive_SpendsBudgetWhereErrorIs) {
  const Scene scene = small_scene(Float(0.1), 0.25, Lambert()); // in caustics few pixels have valid error bars
  for (const PixelSampler sampler : samplers) {
    RenderOptions options = small();
    options.sampler = sampler;
    options.spp = 128;
    options.threads = 1;
    options.adaptive = true;
    double spent_on_all = 0, spent_on_worst = 0;
    RenderResult worst;
    for (options.seed = 0; options.seed < 8; ++options.seed) {
      options.error_scope = ErrorScope::image;
      const RenderResult one = render::render(scene, options);
      EXPECT_NEAR(one.spp, 128, 0.5);
      spent_on_all += one.worst_error;
      options.error_scope = ErrorScope::worst_block;
      worst = render::render(scene, options);
      spent_on_worst += worst.worst_error;
    }
    EXPECT_LE(spent_on_worst, spent_on_all);
    options.threads = 2;
    --options.seed;
    const RenderResult two = render::render(scene, options);
    EXPECT_EQ(worst.rays, two.rays);
    for (std::size_t i = 0; i < two.image.pixels.size(); ++i) {
      EXPECT_TRUE((worst.image.pixels[i] == two.image.pixels[i]).all());
      EXPECT_TRUE((worst.image.variance[i] == two.image.variance[i]).all());
    }
  }
}

TEST(Render, StratifiedAndSobolBeatIndependent) {
  const Scene scene = small_scene(Float(0.1), 0.25, Lambert());
  double error[3];
  for (int i = 0; i < 3; ++i) {
    RenderOptions options = small();
    options.spp = 64;
    options.sampler = samplers[i];
    error[i] = render::render(scene, options).relative_error;
  }
  EXPECT_LE(error[1], error[0]);
  EXPECT_LE(error[2], error[0]);
}

TEST(Render, CountsInvalidSamplesAndKeepsTheFirst) {
  // Direct views of the sky are finite. If both branches of a path hit it, their sum overflows.
  const Scene scene = small_scene(std::numeric_limits<Float>::max());
  RenderOptions options = small();
  options.spp = 8;
  const RenderResult result = render::render(scene, options);
  EXPECT_GE(result.invalid, 1u);
  EXPECT_LE(result.invalid, result.samples);
  EXPECT_EQ(result.first_invalid.pass, 0u);
  for (const Spectrum& p : result.image.pixels) EXPECT_TRUE(p.isFinite().all());
  options.threads = 1;
  const RenderResult again = render::render(scene, options);
  EXPECT_EQ(again.invalid, result.invalid);
  EXPECT_EQ(again.first_invalid.x, result.first_invalid.x);
  EXPECT_EQ(again.first_invalid.y, result.first_invalid.y);
  EXPECT_EQ(again.first_invalid.index, result.first_invalid.index);
  EXPECT_EQ(render::render(small_scene(), options).invalid, 0u);
}

TEST(Render, StopsByTimeErrorOrCancel) {
  const Scene scene = small_scene();
  RenderOptions options = small();
  options.target_error = 0.05;
  const RenderResult exact = render::render(scene, options);
  EXPECT_LE(exact.relative_error, 0.05);
  EXPECT_EQ(exact.estimates, 2u);
  std::uint64_t of_picture = 0, of_worst = 0; // the ends of rounds are random, so one seed is not enough
  for (options.seed = 0; options.seed < 16; ++options.seed) {
    options.error_scope = ErrorScope::image;
    of_picture += render::render(scene, options).samples;
    options.error_scope = ErrorScope::worst_block;
    const RenderResult worst = render::render(scene, options);
    EXPECT_LE(worst.worst_error, 0.05);
    of_worst += worst.samples;
  }
  EXPECT_GT(of_worst, of_picture);
  options.error_scope = ErrorScope::image;
  options.strategy = strategy_from("mis"); // light paths leave less uneven noise
  options.tiles = false;                   // as costly samples in both
  options.branches = 2;
  std::uint64_t adaptive = 0, even = 0;
  for (options.seed = 0; options.seed < 8; ++options.seed) {
    options.adaptive = true;
    adaptive += render::render(scene, options).samples;
    options.adaptive = false;
    even += render::render(scene, options).samples;
  }
  EXPECT_GT(even, adaptive);

  options = small();
  options.seconds = 0.05;
  const RenderResult timed = render::render(scene, options);
  EXPECT_EQ(timed.estimates, 2u);
  EXPECT_FALSE(timed.partial);
  options.spp = -5;       // does not count
  options.seconds = 1e-9; // the first round is always completed
  const RenderResult least = render::render(scene, options);
  EXPECT_EQ(least.samples, 2u * 24 * 20);
  EXPECT_FALSE(least.partial);

  const std::atomic<bool> stop = true;
  options = small();
  options.cancel = &stop;
  const RenderResult cancelled = render::render(scene, options);
  EXPECT_TRUE(cancelled.partial);
  EXPECT_EQ(cancelled.samples, 0u);

  // Cancelled in the second round, the image is complete with variances. Cancelled after the last, it is not partial.
  const std::pair<PixelSampler, int> cases[] = {{PixelSampler::independent, 64},
                                                {PixelSampler::stratified, 64},
                                                {PixelSampler::sobol, 64},
                                                {PixelSampler::sobol, 61}}; // randomisations of one point
  for (const auto& [sampler, spp] : cases)
    for (const bool late : {false, true}) {
      std::atomic<bool> halt = false;
      options = small();
      options.spp = spp;
      options.threads = 1;
      options.sampler = sampler;
      options.cancel = &halt;
      options.progress = [&](const Progress& p) { halt = p.fraction > (late ? 0.999 : 0.1); };
      const RenderResult result = render::render(scene, options);
      EXPECT_EQ(result.partial, !late);
      EXPECT_EQ(result.estimates, 2u);
      EXPECT_EQ(result.image.variance.size(), result.image.pixels.size());
      EXPECT_TRUE(std::isfinite(result.relative_error));
    }
}

// Lamps of radiance 100 before a background. An 8x8 picture has one in each pixel, met by `share` of the samples.
Scene small_lamps(double share, Float background) {
  SceneBuilder builder;
  const BsdfId black = builder.add(Lambert(Spectrum::Zero()));
  constexpr double fov = 53, distance = 8;
  const double side = 2 * std::tan(fov / 2 * mc::pi<double> / 180) * distance / 8; // of a pixel, at the lamps
  const double radius = side * std::sqrt(share / mc::pi<double>);
  for (int x = -4; x < 4; ++x)
    for (int y = -4; y < 4; ++y)
      builder.add(Sphere(Vec3d(side * (x + 0.5), side * (y + 0.5), -distance), radius),
                  {black, Emission{Spectrum::Constant(100)}});
  builder.add(Light(ConstantBackground(Spectrum::Constant(background))));
  builder.set(ThinLens(Transform::look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}), LensOptions{.fov = fov}));
  return builder.build();
}

RenderOptions to_target(double error, int seed) {
  RenderOptions options;
  options.width = options.height = 8;
  options.sampler = PixelSampler::independent;
  options.adaptive = false;
  options.target_error = error;
  options.seed = static_cast<std::uint64_t>(seed);
  return options;
}

// Many pixels have one bright sample or none: these decide the error. With p the probability of a bright sample, n of
// them have the relative standard error 1 / sqrt(p n).
TEST(Render, Target_HoldsWhereOneSampleDominatesPixels) {
  const double share = 0.0003;
  const Scene scene = small_lamps(share, 0);
  int larger = 0, dominated = 0;
  constexpr int seeds = 40;
  for (int seed = 0; seed < seeds; ++seed) {
    const RenderResult result = render::render(scene, to_target(0.9, seed));
    larger += 1 / std::sqrt(share * result.spp) > 0.9;
    dominated += result.outlier_dominated > 0.05;
  }
  EXPECT_LE(larger, 5); // of 40, 2 at most are promised; more than 5 have a probability of 1.4 %
  EXPECT_GE(dominated, seeds / 2);
}

// With 16 samples a pixel most pictures have no bright sample, and seem to have no error.
TEST(Render, Target_WaitsForRareBrightSamples) {
  const double share = 0.0002;
  const Scene scene = small_lamps(share, 1);
  for (int seed = 0; seed < 20; ++seed) {
    const RenderResult result = render::render(scene, to_target(0.1, seed));
    EXPECT_LE(100 * std::sqrt(share / result.spp), 0.1) << seed;
  }
}

TEST(Render, ASceneWithoutLightIsBlack) {
  SceneBuilder builder;
  builder.add(Sphere(Vec3d(0, 0, -3), 1), {builder.add(Lambert())});
  const Scene scene = builder.build();
  RenderOptions options = small();
  options.width = 4;
  options.height = 3;
  options.spp = 4;
  const RenderResult result = render::render(scene, options);
  EXPECT_EQ(result.image.width, 4);
  EXPECT_EQ(result.image.height, 3);
  for (const Spectrum& p : result.image.pixels) EXPECT_TRUE(is_black(p));
  EXPECT_EQ(result.relative_error, 0);
}

TEST(Render, RejectsBadOptions) {
  const Scene scene = small_scene();
  const auto with = [&](auto change) {
    RenderOptions options = small();
    change(options);
    return [&scene, options] { render::render(scene, options); };
  };
  for (const int spp : {0, -3}) EXPECT_THROW(with([&](RenderOptions& o) { o.spp = spp; })(), mc::Error);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(with([&](RenderOptions& o) { o.seconds = bad; })(), mc::Error);
    EXPECT_THROW(with([&](RenderOptions& o) { o.target_error = bad; })(), mc::Error);
  }
}

// The pixels of a crop equal the pixels of the full image, with their variances, for every sampler.
TEST(Render, ACropIsAPartOfTheWhole) {
  const Scene scene = small_scene();
  for (const PixelSampler sampler : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol}) {
    RenderOptions options;
    options.width = 20;
    options.height = 14;
    options.spp = 12;
    options.sampler = sampler;
    options.seed = 4;
    const Image whole = render::render(scene, options).image;
    options.crop = Crop{7, 3, 13, 5};
    const Image part = render::render(scene, options).image;
    ASSERT_EQ(part.width, 13);
    ASSERT_EQ(part.height, 5);
    for (int y = 0; y < part.height; ++y)
      for (int x = 0; x < part.width; ++x) {
        EXPECT_TRUE((part.at(x, y) == whole.at(x + 7, y + 3)).all()) << x << " " << y;
        EXPECT_TRUE((part.variance[part.index(x, y)] == whole.variance[whole.index(x + 7, y + 3)]).all());
      }
  }
}

TEST(Render, ACropLiesInsideThePicture) {
  const Scene scene = small_scene();
  RenderOptions options;
  options.width = 20;
  options.height = 14;
  for (const Crop& c : {Crop{-1, 0, 2, 2}, Crop{0, -1, 2, 2}, Crop{0, 0, 0, 2}, Crop{0, 0, 2, -2}, Crop{19, 0, 2, 2},
                        Crop{0, 13, 2, 2}, Crop{2147483647, 0, 2147483647, 1}}) {
    options.crop = c;
    EXPECT_THROW(render::render(scene, options), mc::Error) << c.x << " " << c.y << " " << c.width << " " << c.height;
  }
}

} // namespace
