#include <render/shape/concept.h>

#include <cmath>

namespace render {

namespace {

// The neighbour of x in the direction of `toward`'s sign.
Float step(Float x, Float toward) {
  return toward > 0 ? std::nextafter(x, mc::infinity<Float>) : toward < 0 ? std::nextafter(x, -mc::infinity<Float>) : x;
}

} // namespace

// The surface lies within `error` of p in each coordinate, so within error * |n|_1 along the normal; one more step per
// coordinate pays for rounding the sum [PharrJakobHumphreys23, section 6.8.6].
Vec3 SurfacePoint::offset_origin(const Vec3& d) const {
  const Float distance = error * ng.lpNorm<1>();
  const Vec3 offset = d.dot(ng) < 0 ? Vec3(-distance * ng) : Vec3(distance * ng);
  const Vec3 o = p + offset;
  return {step(o.x(), offset.x()), step(o.y(), offset.y()), step(o.z(), offset.z())};
}

Ray SurfacePoint::spawn_ray_to(const SurfacePoint& target) const {
  const Vec3 between = target.p - p;
  const Vec3 start = offset_origin(between), end = target.offset_origin(-between);
  // The difference is rounded relative to its length: stop a few such roundings before the end.
  return {start, end - start, 1 - 8 * std::numeric_limits<Float>::epsilon()};
}

} // namespace render
