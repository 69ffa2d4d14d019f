#pragma once
/// How many samples each pixel gets.

#include <render/film/film.h>

namespace render {

/// How many samples each pixel gets, relative to their mean over the picture.
struct SamplingPlan {
  std::vector<float> rates = {}; ///< of mean 1, row by row from the top; empty: all 1

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
///   Of each neighbour: v, variance / radiance^2 of one sample, averaged over the channels, radiance as in
///   Film::relative_error but of the pixel alone; and c, the rays of one sample. Neighbours weigh by the inverse square
///   of their distance. For the error of the picture rates are a power of sqrt(v / c): the one among 0 (even), .5, .75,
///   1 and 1.25 at which the other pixels' variance times rays is least by the pilot, so that what neighbours cannot
///   tell costs little. For the worst block they are as v: all blocks err alike.
///   least  : no rate is below, so that what the pilot missed is met later
///   threads: the plan does not depend on them
///   throws : Error unless 0 < least <= 1
SamplingPlan adaptive_plan(const Film& pilot, double least, ErrorOf of = ErrorOf::picture, int threads = 0,
                           const Tiling& tiling = {});

} // namespace render
