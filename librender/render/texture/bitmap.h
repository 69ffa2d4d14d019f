#pragma once
/// An image texture.

#include <render/texture/texels.h>
#include <render/texture/uv_map.h>

#include <memory>

namespace render {

/// An image, interpolated bilinearly and repeated. Texel centres are at ((x + 1/2) / width, (y + 1/2) / height); v = 0
/// is the upper edge of the top row.
///   throws : Error unless all texels are finite.
class Bitmap {
 public:
  /// A texture over the given texels.
  explicit Bitmap(std::shared_ptr<const Texels> texels, const UvMap& map = UvMap());

  /// Colour at uv.
  Spectrum eval(const Vec2d& uv) const;
  /// Throws Error that begins with `what` unless all texels lie in [0, 1].
  void require_reflectance(std::string_view what) const;

 private:
  std::shared_ptr<const Texels> texels_;
  UvMap map_;
};

} // namespace render
