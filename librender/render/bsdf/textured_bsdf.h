#pragma once
/// BSDFs with parameters that vary over a surface.

#include <render/bsdf/bsdf.h>
#include <render/texture/texture.h>

namespace render {

/// Roughness alpha of facets from a texture: the mean of its channels or the square of it, raised to `least_alpha`.
///   throws : Error unless the texture lies in [0, 1].
class RoughnessTexture {
 public:
  /// Roughness alpha, or its square root as in lajolla.
  explicit RoughnessTexture(Texture texture, bool is_root = false) : texture_(std::move(texture)), is_root_(is_root) {
    texture_.require_reflectance(is_root ? "roughness" : "alpha");
  }
  /// Roughness alpha at uv.
  Float at(const Vec2d& uv, Float footprint = 0) const { return alpha(texture_.eval(uv, footprint).mean()); }
  /// See Texture.
  bool is_filtered() const { return texture_.is_filtered(); }
  /// A lower bound of alpha: the roughness of the smallest value of any channel.
  Float least() const { return alpha(texture_.least()); }

 private:
  Float alpha(Float value) const { return std::clamp(is_root_ ? value * value : value, least_alpha, Float(1)); }

  Texture texture_;
  bool is_root_;
};

/// Textures that replace parameters of a BSDF.
struct BsdfTextures {
  std::optional<Texture> diffuse_reflectance = {};    ///< Albedo of a diffuse surface or base.
  std::optional<Texture> specular_reflectance = {};   ///< Colour of what facets or a smooth surface reflect.
  std::optional<Texture> specular_transmittance = {}; ///< Colour of what they transmit.
  std::optional<RoughnessTexture> alpha = {};         ///< Roughness of the facets.

  /// Whether there is no texture.
  bool empty() const { return !diffuse_reflectance && !specular_reflectance && !specular_transmittance && !alpha; }
};

/// A BSDF with parameters from textures. If a texture may replace the parameter NAME of a BSDF, this has a member
/// set_NAME(value). If its set_alpha() needs tables, it also has prepare_alpha(), which computes them.
///   throws : Error unless the BSDF has the parameters and the textures lie in [0, 1].
class TexturedBsdf {
 public:
  /// The BSDF `untextured` with these textures.
  TexturedBsdf(Bsdf untextured, BsdfTextures textures);

  /// The BSDF with its own colours and, if there is a texture of roughness, its lower bound.
  const Bsdf& untextured() const { return untextured_; }
  /// Whether some texture depends on the footprint.
  bool is_filtered() const { return is_filtered_; }
  /// BSDF at the texture coordinates uv, for a footprint as in Texture. Its colours are at most 1: interpolation may
  /// round above 1.
  Bsdf at(const Vec2d& uv, Float footprint = 0) const;

 private:
  Bsdf untextured_;
  BsdfTextures textures_;
  bool is_filtered_ = false;
};

} // namespace render
