#pragma once
/// Images in memory.

#include <render/core/types.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace render {

/// The quantity that an image shows.
struct Aov {
  /// Kinds of quantities.
  enum Kind {
    radiance, ///< Radiance [W/(m^2 sr)].
    normals,  ///< Shading normal n of the first hit as the colour (n + 1) / 2; without a hit the radiance.
    /// Ambient occlusion of the first hit: visible share of a uniform sky up to `max_distance`; 1 without a hit.
    ambient_occlusion
  };
  /// The quantity.
  Kind kind;
  double max_distance; ///< Range of ambient occlusion [scene units].

  /// A quantity; `r` is the range of ambient occlusion.
  constexpr Aov(Kind w = radiance, double r = mc::infinity<double>) : kind(w), max_distance(r) {}
  /// Whether kind and range are equal.
  bool operator==(const Aov&) const = default;
};

/// Image of linear sRGB radiance, with optional variances. Rows are stored from the top, pixels from the left.
struct Image {
  int width = 0,                                    ///< Number of columns.
      height = 0;                                   ///< Number of rows.
  std::vector<Spectrum> pixels;                     ///< Values.
  std::vector<Spectrum> variance;                   ///< Variance of each pixel's mean, per channel; empty: unknown.
  std::map<std::string, std::vector<float>> layers; ///< Further channels by their names in OpenEXR; see layers.h.
  std::uint32_t estimates = 0; ///< Number of independent estimates per pixel behind the variance; 0: unknown.
  /// The variance of a sum of many pixels is this times the sum of their variances; see SplatFilter.
  double noise_area = 1;
  std::map<std::string, std::string> metadata; ///< Command, seed, samples, commit.

  /// An image without pixels.
  Image() = default;
  /// A black image.
  Image(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), Spectrum::Zero()) {}

  /// Index of pixel (x, y) in `pixels`.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  /// The image, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) {
    a(width, height, pixels, variance, layers, estimates, noise_area, metadata);
  }

  /// Pixel (x, y).
  Spectrum& at(int x, int y) { return pixels[index(x, y)]; }
  /// Pixel (x, y).
  const Spectrum& at(int x, int y) const { return pixels[index(x, y)]; }
};

} // namespace render
