/// Measures the coverage of pixel error bars: the share of 95 % intervals that contain the truth. Prints CSV to stdout.
/// Usage: bench_render_interval SCENE.xml... [-- SEEDS [SIZE [REFERENCE_SPP]]]
///   way    : even, splat (if the filter is wider than a pixel), tiles, or mis (without light paths).
///   alone  : intervals from the variance of the pixel alone, Student's t with 1 degree of freedom.
///   shared : intervals from interval_half_widths.
///   noisy  : intervals from interval_half_widths for the tenth of all pixels and channels with the largest variance in
///            the reference.
///   low, high : share of intervals below and above the truth.

#include "arguments.h"

#include <render/film/confidence_interval.h>
#include <render/io/mitsuba/mitsuba.h>
#include <render/render.h>

#include <mc/stats/t_test.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace {

using namespace render;

struct Coverage {
  double n = 0, low = 0, high = 0;
  void add(double off, double half_width) {
    ++n;
    low += off < -half_width;
    high += off > half_width;
  }
  std::string text() const { return fmt::format("{:.4f},{:.4f},{:.4f}", 1 - (low + high) / n, low / n, high / n); }
};

// Marks the values of the image in the top tenth by variance.
std::vector<Eigen::Array<bool, 3, 1>> noisiest_tenth(const Image& image) {
  std::vector<Float> variances;
  for (const Spectrum& v : image.variance) variances.insert(variances.end(), v.begin(), v.end());
  const auto tenth = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() * 9 / 10);
  std::nth_element(variances.begin(), tenth, variances.end());
  std::vector<Eigen::Array<bool, 3, 1>> noisy;
  for (const Spectrum& v : image.variance) noisy.emplace_back(v >= *tenth && v > 0);
  return noisy;
}

void show(const std::string& path, std::string_view way, const Scene& scene, RenderOptions options, const Image& truth,
          int seeds) {
  const auto is_noisy = noisiest_tenth(truth);
  const double q = mc::student_quantile(0.05, 1);
  for (const int spp : {4, 16, 64, 256}) {
    Coverage alone, shared, noisy;
    double outlier_dominated = 0;
    options.spp = spp;
    for (options.seed = 0; options.seed < std::uint64_t(seeds); ++options.seed) {
      const RenderResult result = render::render(scene, options);
      const Image widths = interval_half_widths(result.image, 0.95);
      outlier_dominated += result.outlier_dominated / seeds;
      for (std::size_t i = 0; i < truth.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
          const double off = double(result.image.pixels[i][c]) - double(truth.pixels[i][c]);
          alone.add(off, q * std::sqrt(double(result.image.variance[i][c])));
          shared.add(off, double(widths.pixels[i][c]));
          if (is_noisy[i][c]) noisy.add(off, double(widths.pixels[i][c]));
        }
    }
    fmt::print("{},{},{},{},{:.4f},{},{},{}\n", std::filesystem::path(path).stem().string(), way, spp, seeds,
               outlier_dominated, alone.text(), shared.text(), noisy.text());
    std::fflush(stdout);
  }
}

void show_ways(const std::string& path, int seeds, int size, int reference_spp) {
  const SceneFile file = read_mitsuba(path);
  RenderOptions options;
  options.width = options.height = size;
  options.spp = reference_spp;
  options.seed = 1'000'000;
  const Image truth = render::render(file.scene, options).image;
  options.adaptive = options.splat = false;
  show(path, "even", file.scene, options, truth, seeds);
  if (SplatFilter(file.scene.filter()).is_wide()) {
    options.splat = true;
    show(path, "splat", file.scene, options, truth, seeds);
  }
  options.splat = false;
  options.tiles = true;
  show(path, "tiles", file.scene, options, truth, seeds);
  options.tiles.reset();
  options.adaptive = options.splat = true;
  show(path, "default", file.scene, options, truth, seeds);
  options.adaptive = options.splat = false;
  options.strategy = strategy_from("mis");
  show(path, "mis", file.scene, options, truth, seeds);
}

} // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv);
  fmt::print("scene,way,spp,seeds,undecided,alone,alone_low,alone_high,shared,shared_low,shared_high,"
             "noisy,noisy_low,noisy_high\n");
  for (const std::string& scene : arguments.scenes)
    show_ways(scene, arguments.number(0, 200), arguments.number(1, 16), arguments.number(2, 100'000));
}
