#pragma once
/// Confidence intervals of pixels.

#include <render/film/image.h>

namespace render {

/// Half the widths of the intervals about the pixels of an image that hold their expectations with probability
/// `confidence`, 0.95 say: of every pixel and channel q sqrt(v), where v is the mean variance of the pixel and its
/// neighbours, at most 3x3, and q the quantile of Student's t with 4 + 4 / A degrees of freedom, where A is the noise
/// area: of pixels that share their noise the variances are fewer. Where a pixel's own variance is over twice that, of
/// two estimates three times, and the image says from how many, it counts alone, with their degrees of freedom.
///   A pixel alone does not know its error where rare bright paths decide: until it meets one it is too dark and says
///   that it is sure. Its neighbours have met some, so they share; and a pixel's variance counts as one observation,
///   however many estimates lie behind it. A lamp smaller than a pixel has no neighbour of its kind.
///   error  : in seven scenes, two with caustics, 95 % intervals held 95 to 98 % of the pixels at 4 to 256 samples, and
///            of the noisiest tenth 90 to 97 %; by the variance of the pixel alone, which two estimates hardly know,
///            all would be five times as wide (notebooks-data/truth/pixel_intervals.csv). Of lamps that cover part of
///            a pixel all held at 16 to 256 samples.
///            Where noise changes within three pixels, the quiet ones get wider intervals than they need.
///   throws : Error unless the image carries its variance and 0 < confidence < 1
Image interval_half_widths(const Image& image, double confidence);

} // namespace render
