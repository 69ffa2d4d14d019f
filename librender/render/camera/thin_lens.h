#pragma once
/// The camera.

#include <render/core/ray.h>

#include <mc/warp/disk.h>

namespace render {

/// A thin lens focused on a plane; lens_radius 0 is a pinhole.
struct ThinLens {
  /// Which side of the film the field of view spans.
  enum class FovAxis { x, y, smaller, larger };

  Vec3 origin = Vec3::Zero();
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY(), forward = -Vec3::UnitZ(); ///< orthonormal
  FovAxis fov_axis = FovAxis::y;
  Float tan_half_fov = 1; ///< tangent of half the field of view along fov_axis
  Float lens_radius = 0, focus_distance = 1;
  Float near = 0; ///< what stands closer before the lens is cut away [scene units]

  /// Tangents of half the horizontal and vertical field of view for a film of width / height = aspect.
  Vec2 tan_half(Float aspect) const {
    const bool along_x = fov_axis == FovAxis::x || (fov_axis == FovAxis::smaller && aspect < 1) ||
                         (fov_axis == FovAxis::larger && aspect >= 1);
    return along_x ? Vec2(tan_half_fov, tan_half_fov / aspect) : Vec2(tan_half_fov * aspect, tan_half_fov);
  }

  /// The ray through the film point s in [0,1]^2, (0,0) its top left corner; u in [0,1)^2 chooses the point of the
  /// lens.
  Ray ray(const Vec2& s, const Vec2& tan_half_xy, const Vec2& u) const {
    const Vec3 toward = right * ((2 * s[0] - 1) * tan_half_xy[0]) + up * ((1 - 2 * s[1]) * tan_half_xy[1]) + forward;
    Vec3 start = origin, d = toward;
    if (lens_radius > 0) {
      const Vec2 lens = lens_radius * mc::UniformDisk<Float>{}.sample(u);
      const Vec3 offset = right * lens[0] + up * lens[1];
      start += offset;
      d = toward - offset / focus_distance;
    }
    // d.dot(forward) = 1, so `near` steps of d reach the near plane.
    return {start + near * d, d.normalized()};
  }
};

} // namespace render
