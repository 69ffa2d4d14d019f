#pragma once
/// Opacity masks: surfaces with holes.

#include <render/texture/texture.h>

#include <algorithm>
#include <optional>

namespace render {

/// Opacity of a surface at each point: the fraction of rays that interact with the surface. All other rays pass
/// through.
///   texture : the opacity is the mean of the channels.
///   throws  : Error unless the opacity lies in [0, 1].
class Mask {
 public:
  /// Constant opacity.
  explicit Mask(Float opacity) : opacity_(opacity) {
    mc::require(opacity >= 0 && opacity <= 1, "mask: opacity {} must lie in [0, 1]", opacity);
  }
  /// Opacity from a texture.
  explicit Mask(Texture opacity) : texture_(std::move(opacity)) { texture_->require_reflectance("mask: opacity"); }

  /// Whether the opacity varies over the surface and needs texture coordinates.
  bool varies() const { return texture_.has_value(); }
  /// Opacity at uv.
  Float opacity(const Vec2d& uv) const {
    return texture_ ? std::min(texture_->eval(uv).mean(), Float(1)) : opacity_; // interpolation may round above 1
  }

 private:
  std::optional<Texture> texture_;
  Float opacity_ = 1;
};

} // namespace render
