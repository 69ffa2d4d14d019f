#pragma once
/// A picture in memory.

#include <render/core/types.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace render {

/// What the pixels of a picture show.
struct Aov {
  enum Kind {
    radiance,
    normals,          ///< of what is seen: the shading normal n as the colour (n + 1) / 2; beyond all surfaces radiance
    ambient_occlusion ///< of what is seen: the share of a uniform sky's light that nothing within `max_distance` keeps from
                      ///< it; beyond all surfaces 1
  };
  Kind kind;
  double max_distance; ///< [scene units]

  constexpr Aov(Kind w = radiance, double r = mc::infinity<double>) : kind(w), max_distance(r) {}
  bool operator==(const Aov&) const = default;
};

/// Row-major pixels, the top row first, linear sRGB radiance; optionally the variance of each pixel's mean, per
/// channel.
struct Image {
  int width = 0, height = 0;
  std::vector<Spectrum> pixels;
  std::vector<Spectrum> variance;                   ///< empty: unknown
  std::map<std::string, std::vector<float>> layers; ///< further channels, by their names in OpenEXR, see layers.h
  std::uint32_t estimates = 0;                      ///< independent estimates per pixel behind the variance; 0: unknown
  /// The variance of a sum of many pixels is this times the sum of their variances, see SplatFilter.
  double noise_area = 1;
  std::map<std::string, std::string> metadata; ///< command, seed, samples, commit

  Image() = default;
  Image(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), Spectrum::Zero()) {}

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  Spectrum& at(int x, int y) { return pixels[index(x, y)]; }
  const Spectrum& at(int x, int y) const { return pixels[index(x, y)]; }
};

} // namespace render
