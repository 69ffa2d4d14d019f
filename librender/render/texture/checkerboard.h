#pragma once
/// A checkerboard of two colours.

#include <render/texture/uv_map.h>

namespace render {

/// A checkerboard. One period, [0,1)^2, contains two squares of each colour; color0 lies at (0, 0) and at (1/2, 1/2).
class Checkerboard {
 public:
  /// A checkerboard of color0 and color1.
  Checkerboard(const Spectrum& color0, const Spectrum& color1, const UvMap& map = UvMap())
      : color0_(color0), color1_(color1), map_(map) {}

  /// Colour at uv, for any footprint.
  Spectrum eval(const Vec2d& uv, Float = 0) const {
    const Vec2d p = map_(uv);
    return (p[0] < 0.5) == (p[1] < 0.5) ? color0_ : color1_;
  }
  /// Squares have sharp edges.
  bool is_filtered() const { return false; }
  /// Smallest value of any channel.
  Float least() const { return color0_.min(color1_).minCoeff(); }
  /// Throws Error that begins with `what` unless both colours lie in [0, 1].
  void require_reflectance(std::string_view what) const {
    checked_reflectance(fmt::format("{}: color0", what), color0_);
    checked_reflectance(fmt::format("{}: color1", what), color1_);
  }

 private:
  Spectrum color0_, color1_;
  UvMap map_;
};

} // namespace render
