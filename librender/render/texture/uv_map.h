#pragma once
/// Where on a texture a surface's point lies.

#include <render/core/types.h>

#include <cmath>

namespace render {

using Vec2d = mc::Vec2<double>;

/// uv -> frac(uv * scale + offset), in [0,1)^2: textures repeat. In double, since a scale of 1000 takes three digits.
///   throws : Error unless all are finite
class UvMap {
 public:
  explicit UvMap(const Vec2d& scale = Vec2d::Ones(), const Vec2d& offset = Vec2d::Zero())
      : scale_(scale), offset_(offset) {
    mc::require(scale.allFinite() && offset.allFinite(), "texture: scale ({}, {}) and offset ({}, {}) must be finite",
                scale[0], scale[1], offset[0], offset[1]);
  }
  Vec2d operator()(const Vec2d& uv) const {
    const Vec2d moved = uv.cwiseProduct(scale_) + offset_;
    return {fraction(moved[0]), fraction(moved[1])};
  }

 private:
  // Rounding carries the fraction of -1e-20 to 1.
  static double fraction(double x) { return std::min(x - std::floor(x), 1 - 0x1p-53); }
  Vec2d scale_, offset_;
};

} // namespace render
