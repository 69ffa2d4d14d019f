#pragma once
/// Diffuse reflection that varies over a surface.

#include <render/bsdf/lambert.h>
#include <render/texture/texture.h>

namespace render {

/// A Lambert for every point of a surface.
///   throws : Error unless all of the texture lies in [0, 1]
class TexturedLambert {
 public:
  explicit TexturedLambert(Texture reflectance) : reflectance_(std::move(reflectance)) {
    reflectance_.require_reflectance("diffuse: reflectance");
  }
  Lambert untextured() const { return Lambert(); }
  /// Interpolation may round above 1.
  Lambert at(const Vec2d& uv) const { return Lambert(reflectance_.eval(uv).min(Float(1))); }

 private:
  Texture reflectance_;
};

} // namespace render
