#pragma once
/// Surfaces with holes.

#include <render/texture/texture.h>

#include <algorithm>
#include <optional>

namespace render {

/// The opacity of a surface, at each of its points: the share of what comes along a ray that meets the surface. The
/// rest goes on as if it were not there.
///   a texture : the mean of its channels
///   throws    : Error unless it lies in [0, 1]
class Mask {
 public:
  explicit Mask(Float opacity) : opacity_(opacity) {
    mc::require(opacity >= 0 && opacity <= 1, "mask: opacity {} must lie in [0, 1]", opacity);
  }
  explicit Mask(Texture opacity) : texture_(std::move(opacity)) { texture_->require_reflectance("mask: opacity"); }

  /// Whether it needs texture coordinates.
  bool varies() const { return texture_.has_value(); }
  Float opacity(const Vec2d& uv) const {
    return texture_ ? std::min(texture_->eval(uv).mean(), Float(1)) : opacity_; // interpolation may round above 1
  }

 private:
  std::optional<Texture> texture_;
  Float opacity_ = 1;
};

} // namespace render
