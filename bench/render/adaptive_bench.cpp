/// Measures efficiency and bias of adaptive sampling and of tiles that share paths. Renders with uniform and adaptive
/// sampling, each also with tiles, alternately. Prints CSV to stdout.
/// Usage: bench_render_adaptive SCENE.xml... [-- SEEDS [SIZE [SPP [REFERENCE_SPP]]]]
///   relmse     : mean of (x - reference)^2 / (reference^2 + 0.01) over pixels, channels and seeds, minus the noise of
///                the reference.
///   relative_error: root mean square over seeds of the error that the images state, see Film.
///   gain       : CPU time times relmse of uniform sampling, divided by the same product of this row; and its standard
///                error.
///   z_mean, z_sd: z-scores of the mean radiance of the images against the reference, by their own error bars. z_mean
///                 has a standard error of 1 / sqrt(SEEDS) and a common error of sqrt(SPP / REFERENCE_SPP) from the
///                 reference. z_sd has a standard error of 1 / sqrt(2 SEEDS). With tiles the stated noise of the mean
///                 is up to twice too large.
///   picture    : squared difference of the mean image to the mean image of uniform sampling, divided by its variance.
///                Mean over the pixels, in green. 1 if both have the same expectation.
///   held       : share of 95 % intervals of pixels that contain the reference.

#include "arguments.h"

#include <render/film/confidence_interval.h>
#include <render/io/mitsuba/mitsuba.h>
#include <render/render.h>

#include <mc/estimate/moments.h>

#include <fmt/format.h>

#include <filesystem>

namespace {

using namespace render;

double square_error(const Image& image, const Image& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double y = double(truth.pixels[i][c]), noise = double(truth.variance[i][c]);
      sum += (mc::sqr(double(image.pixels[i][c]) - y) - noise) / (y * y + 0.01);
    }
  return sum / (3.0 * double(truth.pixels.size()));
}

// z-score of the mean over all pixels and channels.
double z_score(const Image& image, const Image& truth) {
  double off = 0, variance = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    off += (image.pixels[i] - truth.pixels[i]).cast<double>().sum();
    // The channels of a pixel are correlated. The standard error of their sum is at most, and nearly, the sum of their
    // standard errors.
    variance += image.noise_area * mc::sqr(image.variance[i].cast<double>().sqrt().sum()) +
                mc::sqr(truth.variance[i].cast<double>().sqrt().sum());
  }
  return off / std::sqrt(variance);
}

struct Spending {
  const char* name;
  mc::Moments relmse = {}, seconds = {}, error = {}, z = {}, spp = {};
  std::vector<mc::Moments> green = {};
  double held = 0, intervals = 0;

  void add(const RenderResult& result, const Image& truth) {
    relmse.add(square_error(result.image, truth));
    seconds.add(result.cpu_seconds);
    error.add(mc::sqr(result.relative_error));
    z.add(z_score(result.image, truth));
    spp.add(result.spp);
    green.resize(truth.pixels.size());
    for (std::size_t i = 0; i < green.size(); ++i) green[i].add(double(result.image.pixels[i][1]));
    const Image widths = interval_half_widths(result.image, 0.95);
    for (std::size_t i = 0; i < truth.pixels.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        held += std::abs(double(result.image.pixels[i][c]) - double(truth.pixels[i][c])) <= double(widths.pixels[i][c]);
        ++intervals;
      }
  }
  double cost() const { return relmse.mean() * seconds.mean(); }
  double relative_variance() const { return mc::sqr(relmse.std_error() / relmse.mean()); }
};

double difference(const Spending& a, const Spending& b) {
  mc::Moments squares;
  for (std::size_t i = 0; i < a.green.size(); ++i) {
    const double variance = mc::sqr(a.green[i].std_error()) + mc::sqr(b.green[i].std_error());
    if (variance > 0) squares.add(mc::sqr(a.green[i].mean() - b.green[i].mean()) / variance);
  }
  return squares.mean();
}

void show(const std::string& path, int seeds, int size, int spp, int reference_spp) {
  const SceneFile file = read_mitsuba(path);
  RenderOptions options;
  options.width = size;
  options.height = size * file.defaults.height / file.defaults.width;
  options.max_depth = file.defaults.max_depth;
  options.spp = reference_spp;
  options.seed = 1'000'000;
  const Image truth = render::render(file.scene, options).image;
  options.spp = spp;
  std::array<Spending, 5> all = {{{"even"}, {"adaptive"}, {"tiles"}, {"splat"}, {"default"}}};
  const Spending& even = all[0];
  for (std::size_t i = 0; i < all.size() * std::size_t(seeds); ++i) { // alternately, each with its own seeds
    const std::size_t way = i % all.size();
    RenderOptions own = options;
    own.seed = i;
    if (way < 4) { // one switch, or none
      own.adaptive = way == 1;
      own.tiles = way == 2;
      own.splat = way == 3;
      if (way != 2) own.branches = 2;
    }
    all[way].add(render::render(file.scene, own), truth);
  }
  for (const Spending& one : all) {
    const Spending* s = &one;
    const double gain = even.cost() / s->cost(),
                 gain_error = s == &even ? 0 : gain * std::sqrt(even.relative_variance() + s->relative_variance());
    fmt::print("{},{},{:.2f},{:.4f},{:.3g},{:.3g},{:.4f},{:.3f},{:.3f},{:.3f},{:.3f},{:.4f},{:.3f}\n",
               std::filesystem::path(path).stem().string(), s->name, s->spp.mean(), s->seconds.mean(), s->relmse.mean(),
               s->relmse.std_error(), std::sqrt(s->error.mean()), gain, gain_error, s->z.mean(),
               std::sqrt(s->z.variance()), s->held / s->intervals, difference(even, *s));
  }
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv);
  fmt::print(
      "scene,spending,spp,cpu_seconds,relmse,relmse_error,relative_error,gain,gain_error,z_mean,z_sd,held,picture\n");
  for (const std::string& scene : arguments.scenes)
    show(scene, arguments.number(0, 20), arguments.number(1, 64), arguments.number(2, 64), arguments.number(3, 65536));
}
