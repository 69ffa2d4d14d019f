#include <render/shape/concept.h>

namespace render {

std::optional<Ray> SurfacePoint::spawn_ray_to(const SurfacePoint& target, const Vec3& d) const {
  const Vec3 start = offset_origin(d), end = target.offset_origin(-d), between = end - start;
  if (!(between.dot(ng) * d.dot(ng) > 0) || !(between.dot(target.ng) * d.dot(target.ng) > 0)) return {};
  // The difference is rounded relative to its length: the ray stops a few such roundings before the end.
  return Ray{start, between, 1 - 8 * std::numeric_limits<Float>::epsilon()};
}

} // namespace render
