#include <render/light_tracing_pass.h>
#include <render/render.h>
#include <render/scene/builder.h>

#include <mc/core/parallel.h>
#include <mc/estimate/moments.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace render;

/// A white floor fills the view. A lamp, a white ceiling above and a ball of glass are outside the view.
///   unit : scale of all lengths.
Scene lit_floor(const Filter& filter, double unit = 1) {
  SceneBuilder builder;
  builder.add(TriangleMesh::rectangle(Transform::scale({9 * unit, 9 * unit, unit})), {builder.add(Lambert())});
  builder.add(TriangleMesh::rectangle(Transform::translate({0, 0, 7 * unit}) * Transform::rotate(Vec3d::UnitX(), 180) *
                                      Transform::scale({9 * unit, 9 * unit, unit})),
              {builder.add(Lambert())});
  const BsdfId glass = builder.add(Dielectric());
  builder.add(Sphere(unit * Vec3d(0, 0, 5), unit), {builder.add(Lambert(Spectrum::Zero())), Emission{}});
  builder.add(Sphere(unit * Vec3d(0, 0, 11.5), 4 * unit), {glass});
  builder.set(filter);
  builder.set(ThinLens(Transform::look_at({0, 0, 3 * unit}, {0, 0, 0}, {0, 1, 0}), {.fov = 60}));
  return builder.build();
}

struct PassResult {
  Film film;
  RenderStats stats;
};

// Adds light paths, in units of several threads.
void add_paths(const LightTracingPass& pass, std::uint64_t from, std::uint64_t to, int threads, PassResult& all) {
  constexpr std::uint64_t size = LightTracingPass::block_size;
  std::vector<FilmBlock> blocks((to - from + size - 1) / size, {all.film.width(), all.film.height(), all.film.sets()});
  std::vector<RenderStats> stats(blocks.size());
  mc::parallel_for(blocks.size(), threads, [&](std::size_t i) {
    stats[i] = pass.trace(from + i * size, std::min(from + (i + 1) * size, to), blocks[i]);
  });
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    all.film.add(blocks[i]);
    all.stats.merge(stats[i]);
  }
  pass.count_paths(from, to, all.film);
}

// Traces all paths of `spp` samples per pixel in `steps` calls.
PassResult run_pass(const Filter& filter, std::uint64_t steps, int threads, PixelSampler sampler = PixelSampler::sobol,
                    const Crop& part = {0, 0, 16, 12}, unsigned spp = 400, double unit = 1) {
  const Scene scene = lit_floor(filter, unit);
  const auto paths = LightTracer::create(scene, strategy_from("mis+lt"), Float(16) / 12);
  const LightTracingPass pass(scene, *paths, 3, sampler, 7, {16, 12, part});
  PassResult all{{part.width, part.height, 4, {.has_light_paths = true}}, {}};
  const std::uint64_t n = pass.path_count(spp);
  EXPECT_EQ(n, std::uint64_t{spp} * 16 * 12 / 8);
  for (std::uint64_t i = 0; i < steps; ++i) add_paths(pass, i * n / steps, (i + 1) * n / steps, threads, all);
  const auto samples_of_set = spp / 4;
  for (int y = 0; y < part.height; ++y) // every pixel needs samples to have an estimate
    for (int x = 0; x < part.width; ++x)
      for (int set = 0; set < 4; ++set) all.film.add(x, y, set, Eigen::Array3d::Zero(), samples_of_set);
  return all;
}

double sum(const Film& film) {
  double total = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) total += film.estimate(x, y).mean[0];
  return total;
}

// With a light path for eight samples, a single pixel would have none. Its mean over 4000 seeds equals the mean of many
// samples.
TEST(LightTracingPass, TinyImages_KeepLightTracing) {
  const Scene scene = lit_floor(BoxFilter());
  const auto mean_of = [&](unsigned spp, int seeds) {
    mc::Moments moments;
    RenderOptions options;
    options.width = options.height = 1;
    options.spp = spp;
    for (options.seed = 1; options.seed <= std::uint64_t(seeds); ++options.seed)
      moments.add(double(render::render(scene, options).image.pixels[0][0]));
    return moments;
  };
  const mc::Moments one = mean_of(1, 4000), many = mean_of(4096, 8);
  EXPECT_LE(one.std_error(), 0.02 * many.mean());
  EXPECT_NEAR(one.mean(), many.mean(), 4 * std::hypot(one.std_error(), many.std_error())); // alpha = 1e-4
}

// Steps and threads change results only by the rounding of sums in the same order.
TEST(LightTracingPass, IsIndependentOfStepsAndThreads) {
  for (const PixelSampler sampler : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol}) {
    const PassResult single = run_pass(BoxFilter(), 1, 1, sampler), threaded = run_pass(BoxFilter(), 1, 3, sampler);
    EXPECT_EQ(single.stats.rays, threaded.stats.rays);
    EXPECT_EQ(single.stats.samples, 0u);
    const PassResult stepped = run_pass(BoxFilter(), 7, 2, sampler);
    EXPECT_EQ(single.stats.rays, stepped.stats.rays);
    const PassResult part = run_pass(BoxFilter(), 1, 2, sampler, {3, 2, 5, 7});
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 16; ++x) {
        const double light = single.film.estimate(x, y).mean[0];
        EXPECT_EQ(threaded.film.estimate(x, y).mean[0], light);
        EXPECT_NEAR(stepped.film.estimate(x, y).mean[0], light, 1e-9 * light);
        const bool within = x >= 3 && x < 8 && y >= 2 && y < 9;
        EXPECT_EQ(within ? part.film.estimate(x - 3, y - 2).mean[0] : light, light);
      }
  }
}

// On an almost evenly lit floor all filters give the same light: none is lost or counted twice at the edges. About
// 10,000 paths arrive, a sixth of them so close to an edge that the filter matters. Four standard deviations of the
// difference are 1.5 %.
TEST(LightTracingPass, FiltersConserveEnergy) {
  const auto light = [](const Filter& filter) {
    return sum(run_pass(filter, 1, 2, PixelSampler::sobol, {0, 0, 16, 12}, 16'000).film);
  };
  const double expected = light(BoxFilter());
  EXPECT_GT(expected, 0);
  for (const Filter& filter : {Filter(TentFilter()), Filter(GaussianFilter()), Filter(SubpixelTentFilter())})
    EXPECT_NEAR(light(filter) / expected, 1, 0.015);
}

// Lengths up to 1e18: the area of such a lamp and the density of a pixel over it are at the limits of float. Rounding
// moves a few paths across the edges of pixels.
TEST(LightTracingPass, IsScaleInvariant) {
  const double expected = sum(run_pass(BoxFilter(), 1, 2).film);
  for (const double unit : {1e-18, 1e-9, 1e9, 1e18})
    EXPECT_NEAR(sum(run_pass(BoxFilter(), 1, 2, PixelSampler::sobol, {0, 0, 16, 12}, 400, unit).film) / expected, 1,
                0.02)
        << unit;
}

} // namespace
