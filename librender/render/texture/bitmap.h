#pragma once
/// An image texture.

#include <render/texture/image_pyramid.h>
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
enum class TexelFilter {
  bilinear, ///< Interpolates between the four nearest texels.
  nearest,  ///< The nearest texel.
  trilinear ///< Averages over the footprint: bilinear in two images of a pyramid, and linear between them.
};

/// An image, interpolated and continued beyond its edges. Texel centres are at ((x + 1/2) / width, (y + 1/2) / height);
/// v = 0 is the upper edge of the top row.
///   throws : Error unless all texels are finite.
class Bitmap {
 public:
  /// A texture over the given texels.
  explicit Bitmap(std::shared_ptr<const Texels> texels, const UvMap& map = UvMap(), Wrap wrap = Wrap::repeat,
                  TexelFilter filter = TexelFilter::bilinear);

  /// Colour at uv.
  ///   footprint : see Texture.
  Spectrum eval(const Vec2d& uv, Float footprint = 0) const;
  /// Whether it is trilinear.
  bool is_filtered() const { return pyramid_ != nullptr; }
  /// Smallest value of any channel.
  Float least() const;
  /// Throws Error that begins with `what` unless all texels lie in [0, 1].
  void require_reflectance(std::string_view what) const;

 private:
  Spectrum interpolate(const Texels& image, const Vec2d& p) const;

  std::shared_ptr<const Texels> texels_;
  std::shared_ptr<const ImagePyramid> pyramid_; ///< null unless trilinear
  UvMap map_;
  Wrap wrap_;
  TexelFilter filter_;
  double texels_per_uv_; ///< root of the number of texels in the unit square of uv
};

} // namespace render
