#pragma once
/// Compares strategies on one scene.

#include <render/render.h>

#include <mc/estimate/estimate.h>

#include <string_view>
#include <vector>

namespace carlo {

/// Cost and error of one strategy on a small picture.
struct StrategyResult {
  std::string_view name;
  double samples_per_second = 0; ///< per CPU second
  double spp = 0;                ///< samples per pixel
  double relative_error = 0;     ///< see Film::relative_error
  double work = 0;               ///< CPU seconds times the squared relative error: proportional to the cost of a given
                                 ///< error
  double outlier_dominated = 0;  ///< see RenderResult
  mc::Estimate mean;             ///< luminance, averaged over the picture
  bool misses_light = false;     ///< the strategy does not sample all light, so its picture is wrong

  /// The fields, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) {
    std::string word(name);
    a(word, samples_per_second, spp, relative_error, work, outlier_dominated, mean.value, mean.std_error, mean.dof,
      mean.count, misses_light);
    if constexpr (Archive::is_reader) name = render::strategy_from(word).name;
  }
};

/// Renders with every strategy that finds all lights, with the same number of samples. The picture is the one that
/// `settings` describes, reduced so that its longer side has `side` pixels. When settings.cancel is set, it returns the
/// strategies finished so far.
std::vector<StrategyResult> compare_strategies(const render::Scene& scene, render::RenderOptions settings, int side,
                                               int spp);

/// Gives every strategy the same wall-clock time [s] instead, with evenly distributed samples and the unreduced
/// picture.
std::vector<StrategyResult> compare_strategies_for_time(const render::Scene& scene, render::RenderOptions settings,
                                                        double seconds);

/// The settings with the picture reduced so that its longer side has at most `side` pixels.
render::RenderOptions shrink_to_fit(render::RenderOptions settings, int side);

/// The strategy with the most precise mean, among the strategies that sample all light and have a mean above 0. Null if
/// there is none.
const StrategyResult* most_precise(const std::vector<StrategyResult>& all);

} // namespace carlo
