#pragma once
/// How many samples each pixel gets, and how many paths from the lights there are.

#include <render/film/film.h>

namespace render {

/// How many samples each pixel gets, relative to their mean over the picture, and how many paths start at the lights.
struct SamplingPlan {
  std::vector<float> rates = {}; ///< of mean 1, row by row from the top; empty: all 1
  double light_path_scale = 1;   ///< paths from the lights, relative to those that go with the mean

  /// Of a pixel, where the mean over the picture is `mean`.
  std::uint32_t samples(std::size_t pixel, double mean) const {
    return static_cast<std::uint32_t>(std::lround(rates.empty() ? mean : mean * double(rates[pixel])));
  }
};

/// Squares of pixels whose samples are taken together.
struct Tiling {
  int side = 1;     ///< [pixels]
  int x = 0, y = 0; ///< of the film's first pixel in its tile
};

/// Samples where the error is, as far as a pilot has seen. A pixel's rate follows from its neighbours within 8 pixels,
/// not from itself: so the samples of the pilot and those that it asks for are averaged with weights that do not
/// depend on their values, no pixel is biased and its error bar stays true. (That the mean is 1 depends on all pixels,
/// on each of n by about 1/n.) Where pixels share paths by tiles the same holds for these: all of a tile have one rate,
/// which follows from the tiles within 8 of it.
///   Of each neighbour: v, variance / (r s + m^2 / 4) of one sample, averaged over the channels, where m is the mean
///   radiance of the picture, r the pixel's and s = r; and c, the rays of one sample. Neighbours weigh by the inverse
///   square of their distance.
///   For the error of the picture s is the mean of the 3x3 pixels about (of tiles: tiles) where that is less, so that a
///   rare bright sample is not divided by its own square; these 3x3 leave out the one whose rate it is. Rates are a
///   power of sqrt(v / c): the one among 0 (even), .5, .75, 1 and 1.25 at which the variance times rays of the other
///   pixels is least by the pilot, so that what neighbours cannot tell costs little.
///   For the worst block rates are as v: all blocks err alike.
///   Paths from the lights: by the same rule, sqrt(variance / rays) of all of them to that of all samples, from 1 to 4;
///   s = r, so that no pixel adds more than all its samples are worth.
///   least  : no rate is below, so that what the pilot missed is met later
///   threads: the plan does not depend on them
///   throws : Error unless 0 < least <= 1
SamplingPlan adaptive_plan(const Film& pilot, double least, ErrorScope scope = ErrorScope::image, int threads = 0,
                           const Tiling& tiling = {});

} // namespace render
