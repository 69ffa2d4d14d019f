#pragma once
/// A picture as a texture.

#include <render/texture/texels.h>
#include <render/texture/uv_map.h>

#include <memory>

namespace render {

/// Bilinear between texels whose centres are at ((x + 1/2) / width, (y + 1/2) / height), v = 0 being the upper edge of
/// the top row; repeats.
///   throws : Error unless all texels are finite
class Bitmap {
 public:
  explicit Bitmap(std::shared_ptr<const Texels> texels, const UvMap& map = UvMap());

  Spectrum eval(const Vec2d& uv) const;
  void require_reflectance(std::string_view what) const;

 private:
  std::shared_ptr<const Texels> texels_;
  UvMap map_;
};

} // namespace render
