#include <gallery/comparison.h>

#include <mc/run/part_run.h>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

// The mean luminance of a picture. Pixels are independent, or noise_area states how many share their noise. Channels
// are correlated, so their errors are added linearly, which is the worst case.
mc::Estimate mean_luminance(const render::Image& image, std::uint32_t estimates) {
  double sum = 0, variance = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    sum += double(render::luminance(image.pixels[i]));
    if (image.variance.empty()) continue;
    const render::Spectrum deviation = image.variance[i].sqrt();
    const double error = double(render::luminance(deviation));
    variance += error * error * image.noise_area;
  }
  const auto n = double(image.pixels.size());
  return mc::Estimate::from_student_t(sum / n, std::sqrt(variance) / n, n / image.noise_area * (estimates - 1.0),
                                      image.pixels.size());
}

std::vector<StrategyResult> each_strategy(const render::Scene& scene, render::RenderOptions settings) {
  std::vector<StrategyResult> all;
  const std::string name = settings.name;
  mc::IndependentPieces pieces; // a part renders its share of each
  for (const render::Strategy& strategy : complete_strategies(scene)) {
    settings.strategy = strategy;
    settings.name = fmt::format("{} {}", name, strategy.name);
    render::RenderResult r;
    if (!pieces.attempt([&] { r = render::render(scene, settings); })) continue;
    if (r.partial) break;
    all.push_back({strategy.name, double(r.samples) / r.cpu_seconds, r.spp, r.relative_error,
                   r.cpu_seconds * r.relative_error * r.relative_error, r.outlier_dominated,
                   mean_luminance(r.image, r.estimates), misses_light(scene, strategy, settings.max_depth)});
  }
  pieces.end();
  return all;
}

} // namespace

render::RenderOptions shrink_to_fit(render::RenderOptions settings, int side) {
  const double shrink = std::min(1.0, double(side) / std::max(settings.width, settings.height));
  settings.width = std::max(1, static_cast<int>(std::lround(shrink * settings.width)));
  settings.height = std::max(1, static_cast<int>(std::lround(shrink * settings.height)));
  return settings;
}

std::vector<StrategyResult> compare_strategies(const render::Scene& scene, render::RenderOptions settings, int side,
                                               int spp) {
  if (spp < 2) return {}; // no error bars
  settings = shrink_to_fit(settings, side);
  settings.spp = spp;
  settings.seconds.reset();
  settings.target_error.reset();
  settings.progress = nullptr;
  settings.checkpoint = nullptr;
  return each_strategy(scene, settings);
}

std::vector<StrategyResult> compare_strategies_for_time(const render::Scene& scene, render::RenderOptions settings,
                                                        double seconds) {
  settings.seconds = seconds;
  settings.target_error.reset();
  settings.adaptive = false;
  settings.progress = nullptr;
  settings.checkpoint = nullptr;
  return each_strategy(scene, settings);
}

const StrategyResult* most_precise(const std::vector<StrategyResult>& all) {
  const StrategyResult* best = nullptr;
  for (const StrategyResult& s : all)
    if (!s.misses_light && s.mean.value > 0 && (!best || s.mean.std_error < best->mean.std_error)) best = &s;
  return best;
}

} // namespace carlo
