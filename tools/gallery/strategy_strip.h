#pragma once
/// What carlo render --compare-strategies shows.

#include <gallery/comparison.h>

#include <render/film/tone_mapping.h>

#include <array>
#include <string>

namespace carlo {

/// Samples per pixel of the strip's columns.
inline constexpr std::array<int, 6> strip_spp = {1, 4, 16, 64, 256, 1024};

/// The picture that `settings` describes by every strategy that finds all lights, a row each, with the samples per
/// pixel of strip_spp, as `tone` shows them. Empty when settings.cancel is set before the end.
render::Image strategy_strip(const render::Scene& scene, render::RenderOptions settings,
                             const render::ToneMapping& tone);

/// A line for each strategy: its error with the same samples and in the same time, what a given error costs beside the
/// cheapest that misses no light, and the mean of its picture beside that known best, with its standard error.
///   throws : Error where one of them was made with other strategies than the other
std::string strategy_table(const std::vector<StrategyResult>& same_samples,
                           const std::vector<StrategyResult>& same_time);

} // namespace carlo
