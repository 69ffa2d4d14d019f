#pragma once
/// Affine map of texture coordinates.

#include <render/core/types.h>

#include <cmath>

namespace render {

/// A point in double, such as texture coordinates.
using Vec2d = mc::Vec2<double>;

/// Maps uv to frac(uv * scale + offset) in [0,1)^2, so that textures repeat. Computes in double, because a scale of
/// 1000 consumes three digits. From 2^53 on, and where the product overflows, the fraction is 0.
///   throws : Error unless scale and offset are finite.
class UvMap {
 public:
  /// A map with the given scale and offset; the identity on [0,1)^2 by default.
  explicit UvMap(const Vec2d& scale = Vec2d::Ones(), const Vec2d& offset = Vec2d::Zero())
      : scale_(scale), offset_(offset) {
    mc::require(scale.allFinite() && offset.allFinite(), "texture: scale ({}, {}) and offset ({}, {}) must be finite",
                scale[0], scale[1], offset[0], offset[1]);
  }
  /// The mapped coordinates.
  Vec2d operator()(const Vec2d& uv) const {
    const Vec2d moved = unwrapped(uv);
    return {fraction(moved[0]), fraction(moved[1])};
  }
  /// The scale.
  const Vec2d& scale() const { return scale_; }
  /// uv * scale + offset.
  Vec2d unwrapped(const Vec2d& uv) const { return uv.cwiseProduct(scale_) + offset_; }
  /// frac(x) in [0,1). Rounds the fraction of -1e-20 to just below 1 instead of 1. The fraction of infinity is 0.
  static double fraction(double x) {
    const double f = x - std::floor(x);
    return f >= 0 ? std::min(f, 1 - 0x1p-53) : 0;
  }

 private:
  Vec2d scale_, offset_;
};

} // namespace render
