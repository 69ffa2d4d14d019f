#pragma once
/// Footprints of paths.

#include <render/camera/thin_lens.h>

#include <cmath>

namespace render {

/// Cone around a path. Its width at a hit is the size over which textures are averaged.
///   Source : [AkenineMollerEtAl21], for the growth along a ray; [BelcourEtAl17]: a direction of density p stands for a
///            solid angle in proportion to 1 / p.
struct RayCone {
  Float width = 0, ///< Width at the last vertex [scene units].
      spread = 0;  ///< Growth of the width per unit of length.

  /// Cone of a camera ray: a quarter of a pixel wide, since the samples of a pixel are averaged, too.
  ///   width, height : size of the image [pixels].
  static RayCone of_pixel(const ThinLens& camera, int width, int height) {
    constexpr Float share = Float(0.25);
    const Float size = share * 2 * camera.tan_half(Float(width) / Float(height)).y() / Float(height);
    return camera.is_parallel() ? RayCone{size, 0} : RayCone{0, size};
  }

  /// Follows a ray over a distance.
  void advance(Float distance) { width += spread * distance; }
  /// Scatters into a direction of density pdf [1/sr]; 0: mirrored or refracted at a smooth surface.
  void scatter(Float pdf) {
    constexpr Float share = Float(0.1); // of the radius of the solid angle
    if (pdf > 0) spread += share / std::sqrt(mc::pi<Float> * pdf);
  }
  /// Size of the footprint on a surface, at the cosine of incidence: the root of the area.
  Float footprint(Float cosine) const { return width / std::sqrt(std::max(std::abs(cosine), Float(1e-3))); }
};

} // namespace render
