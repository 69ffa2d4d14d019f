#pragma once
/// Diffuse reflection that varies over a surface.

#include <render/bsdf/lambert.h>
#include <render/texture/texture.h>

namespace render {

/// Lambert with a texture as albedo.
///   throws : Error unless the texture lies in [0, 1].
class TexturedLambert {
 public:
  /// Reflector with a textured albedo.
  explicit TexturedLambert(Texture reflectance) : reflectance_(std::move(reflectance)) {
    reflectance_.require_reflectance("diffuse: reflectance");
  }
  /// A Lambert with the default albedo.
  Lambert untextured() const { return Lambert(); }
  /// The BSDF at uv, with an albedo of at most 1: interpolation may round above 1.
  Lambert at(const Vec2d& uv) const { return Lambert(reflectance_.eval(uv).min(Float(1))); }

 private:
  Texture reflectance_;
};

} // namespace render
