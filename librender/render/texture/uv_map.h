#pragma once
/// Where on a texture a surface's point lies.

#include <render/core/types.h>

#include <cmath>

namespace render {

using Vec2d = mc::Vec2<double>;

/// uv -> frac(uv * scale + offset), in [0,1)^2: textures repeat. In double, since a scale of 1000 takes three digits.
/// From 2^53 on nothing is left of the fraction: it is 0, also where the product overflows.
///   throws : Error unless scale and offset are finite
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
  // Rounding carries the fraction of -1e-20 to 1; infinity has none.
  static double fraction(double x) {
    const double f = x - std::floor(x);
    return f >= 0 ? std::min(f, 1 - 0x1p-53) : 0;
  }
  Vec2d scale_, offset_;
};

} // namespace render
