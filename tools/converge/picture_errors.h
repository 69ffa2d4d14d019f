#pragma once
/// Errors and biases of rendering methods, from their pictures and a reference. Pure functions.

#include <converge/measure.h>
#include <converge/picture_measurement.h>

#include <render/film/image.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace carlo {

/// Pictures of one method at one number of samples.
struct PictureSeries {
  double spp = 0;
  std::vector<render::Image> images = {};
  Replicates replicates = {};
  template <class Archive> void archive(Archive& a) { a(spp, images, replicates); }
};

/// The picture that all others are compared with.
struct ReferencePicture {
  render::Image image;
  double spp = 0;
  double noise = 0;        ///< relmse
  double relmse_floor = 0; ///< added to squared pixels in the denominator of relmse, the same for every picture
  template <class Archive> void archive(Archive& a) { a(image, spp, noise, relmse_floor); }
};

/// Least and greatest number of pictures behind each error, if their number is not given.
inline constexpr int first_pictures = 8, most_pictures = 64;

/// Roots of relmse below this are rounding of pixels, not noise.
inline constexpr double rounding_of_pixels = 8 * std::numeric_limits<render::Float>::epsilon();

/// The relmse caused by an image's own noise, from the variances that it states.
double noise(const render::Image& image, const ReferencePicture& reference);

/// The floor for relmse, from the first reference picture.
double relmse_floor_of(const render::Image& image);

/// RMS error of the pictures, with a 95 % interval.
mc::RmsError error_of(const PictureSeries& series, const ReferencePicture& reference);

/// The number of pictures for which the relative standard error of the error is 10 %.
int pictures_needed(const PictureSeries& series, const ReferencePicture& reference);

/// Fits the slope and the centre of a curve, if it has enough errors.
void fit(ConvergenceCurve& curve);

/// `work` is seconds per picture times the relmse of its noise: it does not depend on the number of samples.
struct WorkAndBias {
  Bias bias;
  double work = 0;
  double variance = 0; ///< variance of the logarithm of `work`
  double dof = 1;      ///< degrees of freedom behind `variance`
};

/// Bias and work of one of several methods. The intervals use the jackknife and hold simultaneously for all `methods`.
WorkAndBias bias_of(const PictureSeries& series, const ReferencePicture& reference, std::size_t methods);

/// Sets the errors above which biased methods pay.
void set_break_even_errors(std::vector<WorkAndBias>& all);

} // namespace carlo
