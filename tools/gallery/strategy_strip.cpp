#include <gallery/contact_sheet.h>
#include <gallery/label.h>
#include <gallery/strategy_strip.h>

#include <mc/core/error.h>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

std::string error_percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.3g} %", 100 * share) : "unknown";
}

std::string mean_text(const StrategyResult& s, const StrategyResult* best) {
  if (!best || !(best->mean.value > 0)) return "0";
  return fmt::format("{:.2f} +- {:.2f} %{}", 100 * s.mean.value / best->mean.value,
                     100 * s.mean.std_error / best->mean.value, s.misses_light ? ", misses light" : "");
}

} // namespace

render::Image strategy_strip(const render::Scene& scene, render::RenderOptions settings,
                             const render::ToneMapping& tone) {
  std::vector<render::Image> pictures;
  SheetLabels labels;
  for (const int spp : strip_spp) labels.columns.push_back(fmt::format("{} spp", spp));
  settings.seconds.reset();
  settings.target_error.reset();
  settings.adaptive = false;
  settings.progress = nullptr;
  settings.checkpoint = nullptr;
  for (const render::Strategy& strategy : complete_strategies(scene)) {
    settings.strategy = strategy;
    labels.rows.emplace_back(strategy.name);
    for (const int spp : strip_spp) {
      settings.spp = spp;
      render::RenderResult r = render::render(scene, settings);
      if (r.partial) return {};
      r.image.variance = {};
      for (render::Spectrum& p : r.image.pixels) p = tone_map(p, tone).cast<render::Float>();
      pictures.push_back(std::move(r.image));
    }
  }
  return contact_sheet(pictures, static_cast<int>(strip_spp.size()),
                       std::max({settings.width, settings.height, label_width(labels.columns.back())}), labels);
}

double strategy_strip_memory(const render::Scene& scene, const render::RenderOptions& settings) {
  const double side = std::max(settings.width, settings.height),
               cells = double(complete_strategies(scene).size() * strip_spp.size());
  return sizeof(render::Spectrum) * cells * (double(settings.width) * settings.height + side * side);
}

std::string strategy_table(const std::vector<StrategyResult>& same_samples,
                           const std::vector<StrategyResult>& same_time) {
  mc::require(same_samples.size() == same_time.size(), "strategies: {} with the same samples, {} in the same time",
              same_samples.size(), same_time.size());
  const StrategyResult* best = most_precise(same_samples);
  double least = HUGE_VAL;
  for (const StrategyResult& s : same_samples)
    if (s.work > 0 && s.mean.value > 0 && !s.misses_light) least = std::min(least, s.work);
  std::string text = fmt::format("{:<12}{:>14}{:>10}{:>12}{:>14}  {}\n", "strategy", "same samples", "work",
                                 "same time", "spp in time", "mean");
  for (std::size_t i = 0; i < same_samples.size(); ++i) {
    const StrategyResult &s = same_samples[i], &t = same_time[i];
    mc::require(s.name == t.name, "strategies: {} with the same samples, {} in the same time", s.name, t.name);
    text += fmt::format("{:<12}{:>14}{:>10}{:>12}{:>14.4g}  {}\n", s.name, error_percent(s.relative_error),
                        s.work > 0 && std::isfinite(least) ? fmt::format("{:.3g}x", s.work / least) : "0",
                        error_percent(t.relative_error), t.spp, mean_text(s, best));
  }
  return text;
}

} // namespace carlo
