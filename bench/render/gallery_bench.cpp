/// Tests the error bars of small images of the gallery scenes with every sampler. Prints CSV to stdout.
/// Usage: bench_render_gallery [NAME...] [-- SEEDS [SPP [SIDE [REFERENCE_SPP]]]]
///   outlier_dominated : share of pixels dominated by one sample, see RenderResult; mean over the seeds.
///   z_mean, z_sd : z-scores of the mean green of the images against the reference, by the error bars of both. The
///                  standard error of z_mean is z_sd / sqrt(SEEDS). For normal z, the standard error of z_sd is 1 /
///                  sqrt(2 SEEDS).
///   missed    : share of 95 % intervals, 1.96 standard errors to each side, that do not contain the reference.
///   ratio, ratio_error : mean over all seeds divided by the reference, and its standard error.

#include "arguments.h"

#include <gallery/comparison.h>
#include <gallery/scenes.h>
#include <render/io/mitsuba/mitsuba.h>

#include <mc/estimate/moments.h>
#include <mc/random/hash.h>

#include <fmt/format.h>

#include <cmath>

namespace {

using namespace render;

struct Green {
  double mean = 0, variance = 0;

  explicit Green(const Image& image) {
    const auto n = double(image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      mean += double(image.pixels[i][1]) / n;
      variance += double(image.variance[i][1]) * image.noise_area / (n * n);
    }
  }
};

// An image without noise must equal the reference up to the rounding of floats.
double z_of(const Green& green, const Green& truth) {
  const double error = std::sqrt(green.variance + truth.variance), off = green.mean - truth.mean;
  return std::abs(off) <= 1e-6 * std::abs(truth.mean) && error == 0 ? 0 : off / error;
}

void show(const carlo::GalleryScene& gallery_scene, int seeds, int spp, int side, int reference_spp) {
  const SceneFile file = read_mitsuba(carlo::scene_file(gallery_scene));
  RenderOptions options;
  options.width = file.defaults.width;
  options.height = file.defaults.height;
  options = carlo::shrink_to_fit(options, side);
  options.max_depth = file.defaults.max_depth;
  options.aov = file.defaults.aov;
  const Strategy best = options.strategy;
  if (!gallery_scene.strategy.empty()) options.strategy = strategy_from(gallery_scene.strategy);
  RenderOptions long_ones = options;
  if (!misses_light(file.scene, options.strategy, options.max_depth)) long_ones.strategy = best;
  long_ones.spp = reference_spp;
  long_ones.seed = 1'000'000;
  const Green truth(render::render(file.scene, long_ones).image);
  options.spp = spp;
  const auto place = static_cast<std::uint64_t>(&gallery_scene - carlo::gallery().data());
  for (const auto sampler : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol}) {
    options.sampler = sampler;
    mc::Moments z, mean, outlier_dominated;
    double missed = 0;
    for (int seed = 0; seed < seeds; ++seed) {
      options.seed = mc::hash(place, sampler, seed); // no two rows use the same points
      const RenderResult result = render::render(file.scene, options);
      const Green green(result.image);
      z.add(z_of(green, truth));
      missed += std::abs(z_of(green, truth)) > 1.96;
      mean.add(green.mean);
      outlier_dominated.add(result.outlier_dominated);
    }
    fmt::print("{},{},{},{},{:.4f},{:.3f},{:.3f},{:.3f},{:.5f},{:.5f}\n", gallery_scene.name, name(sampler), spp, seeds,
               outlier_dominated.mean(), z.mean(), std::sqrt(z.variance()), missed / seeds, mean.mean() / truth.mean,
               std::hypot(mean.std_error(), std::sqrt(truth.variance)) / truth.mean);
    std::fflush(stdout);
  }
}

} // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv);
  const int seeds = arguments.number(0, 100), spp = arguments.number(1, 16), side = arguments.number(2, 16),
            reference_spp = arguments.number(3, 16384);
  fmt::print("scene,sampler,spp,seeds,undecided,z_mean,z_sd,missed,ratio,ratio_error\n");
  for (const std::string& scene : arguments.scenes) show(carlo::gallery_scene(scene), seeds, spp, side, reference_spp);
  if (!arguments.scenes.empty()) return 0;
  for (const carlo::GalleryScene& scene : carlo::gallery()) show(scene, seeds, spp, side, reference_spp);
}
