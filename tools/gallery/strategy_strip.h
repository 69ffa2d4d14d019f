#pragma once
/// Output of carlo render --compare-strategies.

#include <gallery/comparison.h>

#include <render/film/tone_mapping.h>

#include <array>
#include <string>

namespace carlo {

/// Samples per pixel of the strip's columns.
inline constexpr std::array<int, 6> strip_spp = {1, 4, 16, 64, 256, 1024};

/// Pictures of the scene by every strategy that samples all of its lights: a labelled row for each strategy, a labelled
/// column for each number of samples per pixel in strip_spp. Empty when settings.cancel is set before the end.
///   tone : from radiance to pixels
render::Image strategy_strip(const render::Scene& scene, render::RenderOptions settings,
                             const render::ToneMapping& tone);

/// Memory that strategy_strip() needs beside that of a render [bytes].
double strategy_strip_memory(const render::Scene& scene, const render::RenderOptions& settings);

/// A line for each strategy. It has the error with equal samples and in equal time, and the cost of a given error
/// relative to the cheapest strategy that samples all light. It has the mean of the picture with its standard error,
/// relative to the most precise mean.
///   throws : Error if the two lists contain different strategies.
std::string strategy_table(const std::vector<StrategyResult>& same_samples,
                           const std::vector<StrategyResult>& same_time);

} // namespace carlo
