#pragma once
/// Paint with colours that vary over a surface.

#include <render/bsdf/smooth_plastic.h>
#include <render/texture/texture.h>

namespace render {

/// RoughPlastic or SmoothPlastic with textures as colours.
///   untextured : the paint, with the colours that have no texture.
///   throws     : Error unless the textures lie in [0, 1].
template <class Plastic> class TexturedPlastic {
 public:
  /// Paint with textures for the colours of base (diffuse) and coat (specular).
  TexturedPlastic(Plastic untextured, std::optional<Texture> diffuse, std::optional<Texture> specular)
      : untextured_(std::move(untextured)), diffuse_(std::move(diffuse)), specular_(std::move(specular)) {
    if (diffuse_) diffuse_->require_reflectance("plastic: diffuseReflectance");
    if (specular_) specular_->require_reflectance("plastic: specularReflectance");
  }
  /// The paint without textures.
  const Plastic& untextured() const { return untextured_; }
  /// The BSDF at uv, with colours of at most 1: interpolation may round above 1.
  Plastic at(const Vec2d& uv) const {
    const auto color = [&](const std::optional<Texture>& texture) -> std::optional<Spectrum> {
      if (!texture) return {};
      return Spectrum(texture->eval(uv).min(Float(1)));
    };
    return untextured_.with_colors(color(diffuse_), color(specular_));
  }

 private:
  Plastic untextured_;
  std::optional<Texture> diffuse_, specular_;
};

} // namespace render
