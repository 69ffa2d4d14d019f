#pragma once
/// Confidence intervals of pixels.

#include <render/film/image.h>

namespace render {

/// Half widths of confidence intervals for the expected values of pixels, per channel. `confidence` is the coverage
/// probability, such as 0.95.
///   width  : q sqrt(v). v is the mean variance over the 3x3 neighbourhood, cropped to the image. q is the two-sided
///            quantile of Student's t with 4 + 4 / A degrees of freedom, where A is the noise area of the image.
///   noisy pixels : a pixel counts alone if its own variance exceeds 2 times v, or 3 times v for two estimates. Its
///                  quantile then has (estimates - 1) degrees of freedom. This needs image.estimates >= 2.
///   throws : Error unless the image carries its variance and 0 < confidence < 1.
/// Neighbours share their variances because a single pixel may underestimate its own. Before it samples a rare bright
/// path, a pixel is too dark and its variance too small. Each pixel counts as one observation of the variance, for any
/// number of estimates. A lamp smaller than a pixel has no similar neighbour, so its pixel counts alone. If the noise
/// changes within three pixels, quiet pixels get wider intervals than necessary. Measured coverage:
/// notebooks-data/truth/pixel_intervals.csv.
Image interval_half_widths(const Image& image, double confidence);

} // namespace render
