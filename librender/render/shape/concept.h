#pragma once
/// What a shape gives: hits, surface points with error bounds, and samples of its area seen from a point.

#include <render/core/ray.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace render {

/// The nearest crossing of a ray: which primitive of which shape, and where on it.
struct Hit {
  double t = 0;         ///< in double, so that large triangles and far spheres are met at a point of theirs
  int shape = 0;        ///< index into the scene's shapes
  int prim = 0;         ///< triangle of a mesh; 0 for a sphere
  Float b1 = 0, b2 = 0; ///< barycentric weights of vertices 1 and 2 (mesh only)
};

/// A point on a surface, computed so that its error is bounded.
///   error : each coordinate of p is within `error` of the true surface
struct SurfacePoint {
  Vec3 p;
  Float error = 0;
  Vec3 ng;      ///< geometric normal, unit; the light-emitting side
  Vec3 ns;      ///< shading normal, unit, same side as ng
  int prim = 0; ///< triangle of a mesh; 0 for all else

  /// Ray origin moved along the normal, to the side that d points to, just beyond the error bound: a ray from there
  /// meets this surface again only where it truly does. No scene-scale epsilon.
  Vec3 offset_origin(const Vec3& d) const {
    // The surface lies within `error` of p in each coordinate, so within error * |n|_1 along the normal
    // [PharrJakobHumphreys23, section 6.8.6]. Rounding the sum moves each coordinate by up to half an ulp: a whole one
    // of the largest is added to the error.
    const Float rounding = std::numeric_limits<Float>::epsilon() * p.lpNorm<Eigen::Infinity>();
    const Float distance = (error + rounding) * ng.lpNorm<1>();
    return p + std::copysign(distance, d.dot(ng)) * ng;
  }
  Ray spawn_ray(const Vec3& d) const { return {offset_origin(d), d}; }
  /// Ray to another surface point, which lies in direction d, that stops before it. None where the two are so close to
  /// the plane of one that rounding turns the ray around: they do not see each other.
  std::optional<Ray> spawn_ray_to(const SurfacePoint& target, const Vec3& d) const;
};

/// A point of a shape chosen to illuminate a reference point.
struct ShapeSample {
  SurfacePoint point;
  Vec3 wi;       ///< unit direction from the reference point
  Float pdf = 0; ///< density of wi [1/sr] as seen from the reference point
};

/// A direction towards a shape.
struct DirectionSample {
  Vec3 wi;       ///< unit
  Float pdf = 0; ///< density of wi [1/sr], whichever point of the shape it meets
};

/// Shapes are a closed set (shape.h). Each models:
///   sample(ref, u)    : u in [0,1)^2 -> a point of the shape as seen from ref, nullopt where none can be seen
///   pdf(ref, wi, hit) : density [1/sr] with which sample(ref, .) picks wi, as far as it is due to the point `hit`
///   pdf(ref, wi)      : density [1/sr] of the direction wi: the sum over all points where it meets the shape
///   sample_direction(ref, u) : a direction towards a point of sample(ref, u), with its density pdf(ref, wi), whatever
///                       rounding makes of the direction; nullopt where none leads there
///   sample_area(u)    : a point of the shape, of density 1 / area(); nullopt where nothing is left that samples
///   area()            : total area
///   box()             : the axis-aligned box around it
///   spread(ref)       : a bound of the projected solid angle [sr] that it fills at ref, however that faces; at most
///                       pi, and close where it is far away and faces ref
///   surface_point     : the point of a Hit
///   has_uv(), uv(hit, its point) : texture coordinates, where it has them;  forget_uvs() : not any more
///   forget_choice()   : what only sample reads is gone: for shapes that nothing aims at
template <class T>
concept ShapeLike = requires(const T s, Vec3 ref, Vec2 u, Vec3 wi, SurfacePoint hit, Ray ray, Hit h) {
  { s.sample(ref, u) } -> std::same_as<std::optional<ShapeSample>>;
  { s.sample_direction(ref, u) } -> std::same_as<std::optional<DirectionSample>>;
  { s.sample_area(u) } -> std::same_as<std::optional<SurfacePoint>>;
  { s.pdf(ref, wi, hit) } -> std::convertible_to<Float>;
  { s.pdf(ref, wi) } -> std::convertible_to<Float>;
  { s.area() } -> std::convertible_to<double>;
  { s.box() } -> std::same_as<Eigen::AlignedBox3d>;
  { s.projected_solid_angle_bound(ref) } -> std::convertible_to<double>;
  { s.surface_point(ray, h) } -> std::same_as<SurfacePoint>;
};

/// The direction towards the point that the shape samples: its sample_direction, where it knows none better.
template <class S>
std::optional<DirectionSample> sample_direction_by_point(const S& shape, const Vec3& ref, const Vec2& u) {
  const auto s = shape.sample(ref, u);
  if (!s) return {};
  return DirectionSample{s->wi, std::max(s->pdf, shape.pdf(ref, s->wi))}; // rounding may carry it past the shape
}

} // namespace render
