#pragma once
/// An image texture.

#include <render/texture/texels.h>
#include <render/texture/uv_map.h>

#include <memory>

namespace render {

/// Values of an image beyond its edges.
enum class Wrap {
  repeat, ///< The image repeats.
  clamp,  ///< The values at the edge continue.
  mirror  ///< The image repeats, every other copy reversed.
};

/// Values between texel centres.
enum class TexelFilter { bilinear, nearest };

/// An image, interpolated and continued beyond its edges. Texel centres are at ((x + 1/2) / width, (y + 1/2) / height);
/// v = 0 is the upper edge of the top row.
///   throws : Error unless all texels are finite.
class Bitmap {
 public:
  /// A texture over the given texels.
  explicit Bitmap(std::shared_ptr<const Texels> texels, const UvMap& map = UvMap(), Wrap wrap = Wrap::repeat,
                  TexelFilter filter = TexelFilter::bilinear);

  /// Colour at uv.
  Spectrum eval(const Vec2d& uv) const;
  /// Smallest value of any channel.
  Float least() const;
  /// Throws Error that begins with `what` unless all texels lie in [0, 1].
  void require_reflectance(std::string_view what) const;

 private:
  std::shared_ptr<const Texels> texels_;
  UvMap map_;
  Wrap wrap_;
  TexelFilter filter_;
};

} // namespace render
