#pragma once
/// What rays meet where masks let a part of them through.

#include <render/scene/scene.h>

namespace render {

/// What is left of a ray beyond a point that it met.
inline Ray continue_past(const Ray& ray, const Hit& hit, const SurfacePoint& point) {
  Ray rest = point.spawn_ray(ray.d);
  rest.t_max = ray.t_max - Float(hit.t);
  return rest;
}

// What few scenes need stays out of the code that all of them run.
namespace detail {

template <class SceneType, class Passes>
[[gnu::noinline]] std::optional<Hit> nearest_hit_with_masks(const SceneType& scene, Ray& ray, std::uint64_t& rays,
                                                            const Passes& passes) {
  for (;;) {
    ++rays;
    const auto hit = scene.intersect(ray);
    if (!hit) return hit;
    const SurfacePoint point = scene.surface_point(ray, *hit);
    const Float opacity = scene.opacity(*hit, point);
    if (opacity == 1 || !passes(opacity)) return hit;
    ray = continue_past(ray, *hit, point);
  }
}

template <class SceneType>
[[gnu::noinline]] Float shadow_transmittance_with_masks(const SceneType& scene, Ray ray,
                                                        const std::optional<SurfacePoint>& end, std::uint64_t& rays) {
  Float share = 1;
  while (share > 0) {
    ++rays;
    const auto hit = scene.intersect(ray);
    if (!hit) return share;
    const SurfacePoint point = scene.surface_point(ray, *hit);
    share *= 1 - scene.opacity(*hit, point);
    const std::optional<Ray> rest = end ? point.spawn_ray_to(*end, ray.d) : continue_past(ray, *hit, point);
    if (!rest) return 0;
    ray = *rest;
  }
  return 0;
}

} // namespace detail

/// The nearest surface that a ray meets and does not pass; the ray then starts where it passed the last one.
///   passes(opacity) : whether it passes a surface of this opacity, in [0, 1)
///   rays            : counts those traced
/// A mask decides what is seen, not how light scatters: what passes one is the same edge of a path, and weighs the same
/// beside what is sampled otherwise, as if nothing had been there.
template <class SceneType, class Passes>
std::optional<Hit> nearest_hit(const SceneType& scene, Ray& ray, std::uint64_t& rays, const Passes& passes) {
  if (scene.has_masks()) [[unlikely]]
    return detail::nearest_hit_with_masks(scene, ray, rays, passes);
  ++rays;
  return scene.intersect(ray);
}

/// The share of light that arrives along a ray, which ends at `end` if that is given: the product of what masks let
/// through; 0 where anything else is in the way.
template <class SceneType>
Float shadow_transmittance(const SceneType& scene, const Ray& ray, const std::optional<SurfacePoint>& end,
                           std::uint64_t& rays) {
  if (scene.has_masks()) [[unlikely]]
    return detail::shadow_transmittance_with_masks(scene, ray, end, rays);
  ++rays;
  return scene.occluded(ray) ? Float(0) : Float(1);
}

} // namespace render
