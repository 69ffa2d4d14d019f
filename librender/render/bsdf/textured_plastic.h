#pragma once
/// Paint whose colours vary over a surface.

#include <render/bsdf/smooth_plastic.h>
#include <render/texture/texture.h>

namespace render {

/// A RoughPlastic or SmoothPlastic for every point of a surface.
///   untextured   : the paint with the colours that do not vary
///   throws : Error unless all of the textures lies in [0, 1]
template <class Plastic> class TexturedPlastic {
 public:
  TexturedPlastic(Plastic untextured, std::optional<Texture> diffuse, std::optional<Texture> specular)
      : untextured_(std::move(untextured)), diffuse_(std::move(diffuse)), specular_(std::move(specular)) {
    if (diffuse_) diffuse_->require_reflectance("plastic: diffuseReflectance");
    if (specular_) specular_->require_reflectance("plastic: specularReflectance");
  }
  const Plastic& untextured() const { return untextured_; }
  /// Interpolation may round above 1.
  Plastic at(const Vec2d& uv) const {
    const auto color = [&](const std::optional<Texture>& texture, const Spectrum& constant) {
      return texture ? Spectrum(texture->eval(uv).min(Float(1))) : constant;
    };
    return untextured_.with_colors(color(diffuse_, untextured_.diffuse()), color(specular_, untextured_.specular()));
  }

 private:
  Plastic untextured_;
  std::optional<Texture> diffuse_, specular_;
};

} // namespace render
