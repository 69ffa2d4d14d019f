#pragma once
/// Adaptive sampling: the distribution of samples over pixels and light paths.

#include <render/film/film.h>

namespace render {

/// Number of samples of each pixel and of light paths, relative to a uniform distribution.
struct SamplingPlan {
  std::vector<float> rates = {}; ///< Rate of each pixel, row by row from the top, with mean 1; empty: all 1.
  double even = 0;               ///< Samples of every pixel to which the rates do not apply.
  double light_path_scale = 1;   ///< Number of light paths relative to the plan without adaption.

  /// The plan, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(rates, even, light_path_scale); }

  /// The plan for a film with a border, whose pixels have the rates of the nearest pixels of the film. The rates apply
  /// from `from` samples per pixel on.
  SamplingPlan with_border(int width, int height, int border, double from) const;

  /// Number of samples of a pixel for `mean` samples per pixel over the image.
  std::uint32_t samples(std::size_t pixel, double mean) const {
    return static_cast<std::uint32_t>(std::lround(rates.empty() ? mean : even + (mean - even) * double(rates[pixel])));
  }
};

/// Square tiles of pixels that are sampled together.
struct Tiling {
  int side = 1; ///< Width and height of a tile [pixels].
  int x = 0,    ///< Column of the film's first pixel in its tile.
      y = 0;    ///< Row of the film's first pixel in its tile.
};

/// Memory of adaptive_plan() and its plan for each pixel [bytes].
inline constexpr int planning_bytes = 72;

/// Plans samples in proportion to the error that a pilot measured. See docs/methods/adaptive-sampling.md. The rate of a
/// pixel follows from its neighbours within 8 pixels, never from its own samples. The samples of the pilot and the
/// planned samples are averaged with weights that do not depend on their values. So no pixel is biased, and its error
/// bar stays valid. The normalisation to mean 1 depends on all n pixels, on each by about 1/n. If pixels share paths in
/// tiles, tiles take the place of pixels: one rate per tile, from the tiles within a distance of 8.
///   v     : variance / (r s + m^2 / 4) of one sample of a neighbour, averaged over channels. m is the image's mean
///           radiance and r the neighbour's radiance. s is the minimum of r and of the mean over its 3x3 pixels without
///           the planned pixel. So a rare bright sample is not divided by its own square.
///   c     : number of rays of one sample of a neighbour. Neighbours weigh by the inverse square of their distance.
///   rates : for ErrorScope::image a power of sqrt(v / c). The exponent is 0, .5, .75, 1 or 1.25, whichever minimizes
///           variance times rays over the other pixels of the pilot. Thus badly predicted variances cost little.
///   worst block : rates are proportional to v with s = r, so that all blocks have the same error.
///   light paths : sqrt(variance / rays) of all light paths over the same ratio of all samples, clamped to [1, 4], with
///                 s = r.
///   least   : lower bound of all rates, so that sampling continues where the pilot missed features.
///   threads : number of threads; the plan does not depend on it.
///   throws  : Error unless 0 < least <= 1.
SamplingPlan adaptive_plan(const Film& pilot, double least, ErrorScope scope = ErrorScope::image, int threads = 0,
                           const Tiling& tiling = {});

} // namespace render
