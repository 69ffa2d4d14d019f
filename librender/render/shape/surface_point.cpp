#include <render/shape/concept.h>

#include <cmath>

namespace render {

// The surface lies within `error` of p in each coordinate, so within error * |n|_1 along the normal
// [PharrJakobHumphreys23, section 6.8.6]. Rounding the sum moves each coordinate by up to half an ulp: a whole one of
// the largest is added to the error.
Vec3 SurfacePoint::offset_origin(const Vec3& d) const {
  const Float rounding = std::numeric_limits<Float>::epsilon() * p.lpNorm<Eigen::Infinity>();
  const Float distance = (error + rounding) * ng.lpNorm<1>();
  return p + std::copysign(distance, d.dot(ng)) * ng;
}

std::optional<Ray> SurfacePoint::spawn_ray_to(const SurfacePoint& target, const Vec3& d) const {
  const Vec3 start = offset_origin(d), end = target.offset_origin(-d), between = end - start;
  if (!(between.dot(ng) * d.dot(ng) > 0) || !(between.dot(target.ng) * d.dot(target.ng) > 0)) return {};
  // The difference is rounded relative to its length: stop a few such roundings before the end.
  return Ray{start, between, 1 - 8 * std::numeric_limits<Float>::epsilon()};
}

} // namespace render
