#pragma once
/// Confidence intervals of pixels.

#include <render/film/image.h>

namespace render {

/// Half the widths of the intervals about the pixels of an image that hold their expectations with probability
/// `confidence`, 0.95 say: of every pixel and channel q sqrt(v), where v is the mean variance of the pixel and its
/// neighbours, at most 3x3, and q the quantile of Student's t with 8 degrees of freedom. Where a pixel's own variance
/// is over twice that, and the image says from how many estimates, it counts alone, with their degrees of freedom.
///   A pixel alone does not know its error where rare bright paths decide: until it meets one it is too dark and says
///   that it is sure. Its neighbours have met some, so they share; and a pixel's variance counts as one observation,
///   however many estimates lie behind it. A lamp smaller than a pixel has no neighbour of its kind.
///   error  : in seven scenes, two with caustics, 95 % intervals held 97 to 98 % of the pixels at 4 to 256 samples, and
///            of the noisiest tenth 88 to 97 % at 4 and 90 to 98 % from 16 on; with the variance of the pixel alone it
///            is 80 to 97 %, most misses too low (notebooks-data/truth/pixel_intervals.csv). Of lamps that cover part
///            of a pixel 95 to 98 % at 16 to 256 samples.
///            Where noise changes within three pixels, the quiet ones get wider intervals than they need.
///            Where one point set in seventy differs from the rest, as where nearly all put as many of their points
///            towards one of two lights, most neighbourhoods agree: of two directional lights of irradiance 20 and 3
///            34 % of the intervals held at 16 samples; the others were 0 wide and the pixels .3 % off.
///   throws : Error unless the image carries its variance and 0 < confidence < 1
Image half_widths(const Image& image, double confidence);

} // namespace render
