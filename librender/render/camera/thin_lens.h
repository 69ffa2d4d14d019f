#pragma once
/// The camera.

#include <render/core/ray.h>

#include <mc/warp/disk.h>

namespace render {

/// A thin lens focused on a plane; lens_radius 0 is a pinhole.
///   ray(s, u) : s in [0,1]^2 across the film, (0,0) its top left corner; u in [0,1)^2 chooses the point of the lens
///   The ray starts on the plane at distance `near` before the lens [scene units], so that what stands closer is cut away.
struct ThinLens {
  Vec3 origin = Vec3::Zero();
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY(), forward = -Vec3::UnitZ(); ///< orthonormal
  Float tan_half_x = 1, tan_half_y = 1; ///< tangents of half the horizontal and vertical field of view
  Float lens_radius = 0, focus_distance = 1, near = 0;

  Ray ray(const Vec2& s, const Vec2& u) const {
    const Vec3 toward = right * ((2 * s[0] - 1) * tan_half_x) + up * ((1 - 2 * s[1]) * tan_half_y) + forward;
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
