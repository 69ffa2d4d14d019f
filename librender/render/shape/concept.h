#pragma once
/// Concept of a shape: hits, surface points with error bounds, and samples of the shape from a reference point.

#include <render/core/bounds.h>
#include <render/core/ray.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace render {

/// The nearest crossing of a ray with a shape.
struct Hit {
  /// Ray parameter. In double, so that hits on large triangles and far spheres lie on the surface.
  double t = 0;
  int shape = 0; ///< Index into the shapes of the scene.
  int prim = 0;  ///< Triangle of a mesh; 0 for a sphere.
  Float b1 = 0,  ///< Barycentric weight of vertex 1 (mesh only).
      b2 = 0;    ///< Barycentric weight of vertex 2 (mesh only).
};

/// A point on a surface with an error bound.
///   error : each coordinate of p is within `error` of the true surface.
struct SurfacePoint {
  Vec3 p;          ///< Position.
  Float error = 0; ///< Error bound of each coordinate of p.
  Vec3 ng;         ///< Geometric normal, unit; points to the light-emitting side.
  Vec3 ns;         ///< Shading normal, unit, on the same side as ng.
  int prim = 0;    ///< Triangle of a mesh; 0 for other shapes.

  /// Ray origin just beyond the error bound, moved along the normal to the side of d. A ray from there hits this
  /// surface again only where it truly does. There is no epsilon that depends on the scale of the scene.
  Vec3 offset_origin(const Vec3& d) const {
    // The surface lies within `error` of p in each coordinate, so within error * |n|_1 along the normal
    // [PharrJakobHumphreys23, section 6.8.6]. Rounding the sum moves each coordinate by up to half an ulp, so a whole
    // ulp of the largest coordinate is added.
    const Float rounding = std::numeric_limits<Float>::epsilon() * p.lpNorm<Eigen::Infinity>();
    const Float distance = (error + rounding) * ng.lpNorm<1>();
    return p + std::copysign(distance, d.dot(ng)) * ng;
  }
  /// Ray from this point in direction d.
  Ray spawn_ray(const Vec3& d) const { return {offset_origin(d), d}; }
  /// Ray to another surface point in direction d, which stops before that point. nullopt if both points are so close to
  /// the plane of one of them that rounding reverses the ray: they are not mutually visible.
  std::optional<Ray> spawn_ray_to(const SurfacePoint& target, const Vec3& d) const;
};

/// A point of a shape, sampled to illuminate a reference point.
struct ShapeSample {
  SurfacePoint point; ///< The point.
  Vec3 wi;            ///< Unit direction from the reference point.
  Float pdf = 0;      ///< Density of wi [1/sr] at the reference point.
};

/// A direction towards a shape.
struct DirectionSample {
  Vec3 wi;       ///< Unit direction from the reference point.
  Float pdf = 0; ///< Density of wi [1/sr], summed over all points of the shape along it.
};

/// Shapes are a closed set (shape.h). Each models:
///   sample(ref, u)    : maps u in [0,1)^2 to a point of the shape and its direction from ref; nullopt if no point is
///                       visible.
///   pdf(ref, wi, hit) : density [1/sr] with which sample(ref, .) samples wi by the point `hit`.
///   pdf(ref, wi)      : density [1/sr] of the direction wi: the sum over all points of the shape along wi.
///   sample_direction(ref, u) : direction to a point of sample(ref, u), with its density pdf(ref, wi) > 0. Rounding of
///                              the direction does not make the density 0. nullopt if there is no such direction.
///   sample_area(u)    : a point of the shape with density 1 / area(). nullopt after discard_sampling_table().
///   area()            : total area.
///   box()             : axis-aligned bounding box.
///   bounding_ball()   : a ball that contains the shape.
///   is_spherical()    : whether the shape is a sphere or a part of one, so that directions toward it cost little and
///                       fill its bounding ball.
///   projected_solid_angle_bound(ref) : upper bound of the projected solid angle [sr] of the shape at ref, for any
///                                      orientation of the receiver. At most pi, and close for a distant shape that
///                                      faces ref.
///   surface_point(ray, hit) : the point of a Hit.
///   has_uv(), uv(hit, point) : texture coordinates, if the shape has any; uv(point) for a point without its hit.
///   uv_scale(hit, point) : root of the area in texture coordinates over the area on the surface, around the point.
///   discard_uvs()     : frees the texture coordinates.
///   discard_sampling_table() : frees the data that only sampling reads, for shapes that are never sampled.
template <class T>
concept ShapeLike = requires(const T s, Vec3 ref, Vec2 u, Vec3 wi, SurfacePoint hit, Ray ray, Hit h) {
  { s.sample(ref, u) } -> std::same_as<std::optional<ShapeSample>>;
  { s.sample_direction(ref, u) } -> std::same_as<std::optional<DirectionSample>>;
  { s.sample_area(u) } -> std::same_as<std::optional<SurfacePoint>>;
  { s.pdf(ref, wi, hit) } -> std::convertible_to<Float>;
  { s.pdf(ref, wi) } -> std::convertible_to<Float>;
  { s.area() } -> std::convertible_to<double>;
  { s.box() } -> std::same_as<Eigen::AlignedBox3d>;
  { s.bounding_ball() } -> std::same_as<Ball>;
  { s.is_spherical() } -> std::convertible_to<bool>;
  { s.projected_solid_angle_bound(ref) } -> std::convertible_to<double>;
  { s.surface_point(ray, h) } -> std::same_as<SurfacePoint>;
  { s.uv_scale(h, hit) } -> std::convertible_to<double>;
};

/// Direction to the point that shape.sample returns: the sample_direction of shapes without a better method.
template <class S>
std::optional<DirectionSample> sample_direction_by_point(const S& shape, const Vec3& ref, const Vec2& u) {
  const auto s = shape.sample(ref, u);
  if (!s) return {};
  return DirectionSample{s->wi, std::max(s->pdf, shape.pdf(ref, s->wi))}; // rounding may move wi off the shape
}

} // namespace render
