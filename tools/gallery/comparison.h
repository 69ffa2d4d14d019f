#pragma once
/// The strategies side by side on one scene.

#include <render/render.h>

#include <mc/estimate/estimate.h>

#include <string_view>
#include <vector>

namespace carlo {

/// What one strategy makes of a small picture.
struct StrategyResult {
  std::string_view name;
  double samples_per_second = 0; ///< per CPU second
  double spp = 0;                ///< samples per pixel
  double relative_error = 0;     ///< see Film::relative_error
  double work = 0;               ///< CPU seconds times the square of that: what a given error costs
  double outlier_dominated = 0;  ///< see RenderResult
  mc::Estimate mean;             ///< luminance, mean of the picture
  bool misses_light = false;     ///< so that it is wrong, however cheap
};

/// Every strategy that finds all lights, with the same samples, on the picture that `settings` describes made so small
/// that its longer side has `side` pixels. Stops early when settings.cancel is set: then there are fewer.
std::vector<StrategyResult> compare_strategies(const render::Scene& scene, render::RenderOptions settings, int side,
                                               int spp);

/// The same with the same time for each, wall-clock [s], samples spent evenly, on the picture as it is.
std::vector<StrategyResult> compare_strategies_for_time(const render::Scene& scene, render::RenderOptions settings,
                                                        double seconds);

/// The picture that `settings` describes, made so small that its longer side has at most `side` pixels.
render::RenderOptions shrink_to_fit(render::RenderOptions settings, int side);

/// The strategy whose mean is known best, of those that miss no light and have found some; null where there is none.
const StrategyResult* most_precise(const std::vector<StrategyResult>& all);

} // namespace carlo
