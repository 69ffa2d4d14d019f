#pragma once
/// A picture in memory.

#include <render/core/types.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace render {

/// What the pixels of a picture show.
enum class Shown {
  radiance,
  normals ///< of what is seen: the shading normal n as the colour (n + 1) / 2; beyond all surfaces radiance
};

/// Row-major pixels, the top row first, linear sRGB radiance; optionally the variance of each pixel's mean, per
/// channel.
struct Image {
  int width = 0, height = 0;
  std::vector<Spectrum> pixels;
  std::vector<Spectrum> variance;              ///< empty: unknown
  std::uint32_t estimates = 0;                 ///< independent estimates per pixel behind the variance; 0: unknown
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
