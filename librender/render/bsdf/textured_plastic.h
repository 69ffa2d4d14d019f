#pragma once
/// Paint whose colours vary over a surface.

#include <render/bsdf/smooth_plastic.h>
#include <render/texture/texture.h>

namespace render {

/// A RoughPlastic or SmoothPlastic for every point of a surface.
///   bare   : the paint with the colours that do not vary
///   throws : Error unless all of the textures lies in [0, 1]
template <class Paint> class TexturedPlastic {
 public:
  TexturedPlastic(Paint bare, std::optional<Texture> diffuse, std::optional<Texture> specular)
      : bare_(std::move(bare)), diffuse_(std::move(diffuse)), specular_(std::move(specular)) {
    if (diffuse_) diffuse_->require_reflectance("plastic: diffuseReflectance");
    if (specular_) specular_->require_reflectance("plastic: specularReflectance");
  }
  const Paint& bare() const { return bare_; }
  /// Interpolation may round above 1.
  Paint at(const Vec2d& uv) const {
    const auto color = [&](const std::optional<Texture>& texture, const Spectrum& constant) {
      return texture ? Spectrum(texture->eval(uv).min(Float(1))) : constant;
    };
    return bare_.in_colors(color(diffuse_, bare_.diffuse()), color(specular_, bare_.specular()));
  }

 private:
  Paint bare_;
  std::optional<Texture> diffuse_, specular_;
};

} // namespace render
